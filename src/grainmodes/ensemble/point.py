"""All blocks of seeds and all observables of one point (n, phi, k_T), merged sample by sample.

Each seed of any block becomes one row, in the order of the seeds. A point keeps the variables with
one number per sample, and those with one number per mode, bin, step strain, state, event, bracket
or pair of a sample. Coordinates of grains stay in the files of the packings and of their shear. A
sample is converged if it is converged in every observable of the point. A seed that an observable
lacks has NaN there (integers: 0), hence also converged = 0. If two observables have a variable of
the same name, the first in the order of `STAGES` is kept.

Of a stage of single samples, such as `fields`, a point keeps what was lost and how it was made.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block, BlockError, content_of, read_block
from grainmodes.dataset.lost import KINDS, merge_lost
from grainmodes.dataset.padding import stack_padded
from grainmodes.dataset.variable import is_gathered
from grainmodes.parameters.stages import gathered

STAGES = tuple(stage.output for stage in gathered())
"""Values of the attribute `stage` that a point gathers, the first of which keeps a name."""

SINGLE_SAMPLE_STAGES = {stage.output for stage in gathered() if stage.single_sample}
"""Those of which it keeps no variables."""

SHARED_SETTINGS = {
    "normal": "normal contact law",
    "law": "contact law",
    "compression": "settings of the compression",
}
"""What all stages of a point have in common in their configuration → its words in a message."""


def gather_point(paths: list[str | Path]) -> Block:
    """The blocks of one point, read and merged.

    Raises:
        BlockError: a file is not a block or is given twice, the files belong to different points or
            parameters, or a seed occurs twice in an observable.
    """
    names = [str(path) for path in paths]
    for name in names:
        if names.count(name) > 1:
            raise BlockError(f"{name}: expected every file once, got it {names.count(name)} times")
    return merge_blocks({name: read_block(name) for name in names})


def merge_blocks(blocks: dict[str, Block]) -> Block:
    """Blocks of one point as one block of attribute stage = "point".

    Args:
        blocks: name for messages → block, in any order.

    Raises:
        BlockError: as `gather_point`.
    """
    stages = _by_stage(blocks)
    seeds = np.unique(np.concatenate([block.variables["seed"] for block in blocks.values()]))
    variables = {"seed": seeds, "converged": np.ones(len(seeds), dtype=np.int8)}
    for stage, members in stages.items():
        if stage in SINGLE_SAMPLE_STAGES:
            continue
        aligned = _aligned(members, seeds)
        variables["converged"] &= aligned["converged"]
        for name, rows in aligned.items():
            variables.setdefault(name, rows)
    return Block(variables, _attributes(blocks, stages))


def _by_stage(blocks: dict[str, Block]) -> dict[str, dict[str, Block]]:
    found: dict[str, dict[str, Block]] = {stage: {} for stage in STAGES}
    for name, block in blocks.items():
        stage = block.attributes.get("stage")
        if stage not in STAGES:
            raise BlockError(
                f"{name}: expected a block of one of {', '.join(STAGES)}, got {content_of(block)}"
            )
        found[stage][name] = block
    return {stage: _in_seed_order(stage, members) for stage, members in found.items() if members}


def _in_seed_order(stage: str, members: dict[str, Block]) -> dict[str, Block]:
    owner: dict[int, str] = {}
    for name, block in members.items():
        for seed in block.variables["seed"].tolist():
            if seed in owner:
                raise BlockError(
                    f"{name}: duplicate seed {seed} of {stage}, {owner[seed]} holds it too"
                )
            owner[seed] = name
    return dict(sorted(members.items(), key=lambda item: item[1].variables["seed"].min()))


def _aligned(members: dict[str, Block], seeds: np.ndarray) -> dict[str, np.ndarray]:
    """The variables of one observable, one row per seed of the point.

    A series has the length of the longest one among the samples; shorter ones are padded.
    """
    found: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {}
    for block in members.values():
        place = np.searchsorted(seeds, block.variables["seed"])
        for name, array in block.variables.items():
            if name != "seed" and is_gathered(VARIABLES[name]):
                found.setdefault(name, []).append((place, array))
    return {name: _together(parts, len(seeds)) for name, parts in found.items()}


def _together(parts: list[tuple[np.ndarray, np.ndarray]], size: int) -> np.ndarray:
    """Rows of several blocks, each (places, array), as one array of `size` rows."""
    rows: list[np.ndarray | None] = [None] * size
    for places, array in parts:
        for place, row in zip(places, array, strict=True):
            rows[place] = row
    return stack_padded(rows, np.nan if parts[0][1].dtype.kind == "f" else 0)


def _attributes(blocks: dict[str, Block], stages: dict[str, dict[str, Block]]) -> dict[str, object]:
    versions = {str(block.attributes.get("code_version", "unknown")) for block in blocks.values()}
    config = {stage: _decoded(_shared("config", part)) for stage, part in stages.items()}
    _check_settings(blocks)
    return {
        "title": "Samples of one point, all observables",
        "stage": "point",
        **{name: _shared(name, blocks) for name in ("n", "phi", "kt")},
        "code_version": ", ".join(sorted(versions)),
        "config": config,
        **{kind: merge_lost(block.mapping(kind) for block in blocks.values()) for kind in KINDS},
    }


def _check_settings(blocks: dict[str, Block]) -> None:
    """Check that all blocks were made with the same contact law and the same compression.

    Raises:
        BlockError: two of them were not.
    """
    for name, words in SHARED_SETTINGS.items():
        made = {
            path: config[name]
            for path, config in ((path, block.mapping("config")) for path, block in blocks.items())
            if name in config
        }
        first = next(iter(made), "")
        for path, value in made.items():
            if value != made[first]:
                raise BlockError(
                    f"{path}: expected the {words} {made[first]} as in {first}, got {value}"
                )


def _shared(attribute: str, blocks: dict[str, Block]) -> object:
    """The value of an attribute, which must be the same in all blocks that have it."""
    values = {
        name: block.attributes[attribute]
        for name, block in blocks.items()
        if attribute in block.attributes
    }
    if not values:
        raise BlockError(f"{', '.join(blocks)}: expected the attribute {attribute}, got none")
    (first, value), *others = values.items()
    for name, other in others:
        if other != value:
            raise BlockError(f"{name}: expected {attribute} = {value} as in {first}, got {other}")
    return value


def _decoded(text: object) -> object:
    return json.loads(text) if isinstance(text, str) else text
