"""Samples as rows of a block: a sample that is lost is a row without numbers; the others go on.

Why it is lost stands in the attributes of `dataset.lost`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block, BlockError
from grainmodes.dataset.lost import KINDS, merge_lost
from grainmodes.dataset.padding import stack_padded
from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.linalg.pinned_factor import FloppyError
from grainmodes.packing.box import PackingError
from grainmodes.parameters.law import ContactLaw
from grainmodes.runtime.provenance import code_version

SAMPLE_ERRORS = (*NUMERICAL_ERRORS, PackingError)
"""Errors of a single sample; any other one is of the machine or of the code, and ends the job."""

Sample = Callable[[int], dict[str, Any]]
"""Row number → values of the row by name."""

FILL = {"f8": np.nan, "i8": 0, "i4": -1, "i1": 0}
"""Value that stands for a number that does not exist, by its type."""


def loss(errors: Mapping[str, Exception | None]) -> dict[str, str]:
    """What the errors of a sample leave in its row: the reason under `failures` or `not_rigid`.

    Nothing without an error. A sample is not rigid where all of its errors are a `FloppyError`.

    Args:
        errors: the part of the sample that ended with an error, "" for the whole → the error.
    """
    found = {part: error for part, error in errors.items() if error is not None}
    if not found:
        return {}
    floppy = all(isinstance(error, FloppyError) for error in found.values())
    reasons = [
        f"{part}: " * bool(part) + f"{type(error).__name__}: {error}"
        for part, error in found.items()
    ]
    return {"not_rigid" if floppy else "failures": "; ".join(reasons)}


def compute_block(
    seeds: Iterable[int],
    sample: Sample,
    attributes: dict[str, Any],
    earlier: Block | None = None,
) -> Block:
    """Compute a row for every seed, and stack the rows.

    Args:
        seeds: one row each, in this order.
        sample: takes the number of a row and returns its values by name. It raises one of
            `SAMPLE_ERRORS` where it fails; where it fails but has values, it returns them with the
            reason under `failures` or `not_rigid`, as `loss` does.
        attributes: attributes of the block besides the code version and the lost samples.
        earlier: the block that the samples come from; samples lost there have no row here.
    """
    seeds, rows = list(seeds), []
    lost = {kind: merge_lost([earlier.mapping(kind)] if earlier else []) for kind in KINDS}
    known = {seed for stages in lost.values() for entries in stages.values() for seed in entries}
    for number, seed in enumerate(seeds):
        row: dict[str, Any] = {}
        if str(seed) not in known:
            try:
                row = sample(number)
            except SAMPLE_ERRORS as error:
                row = loss({"": error})
        for kind in KINDS:
            if kind in row:
                entries = lost[kind].setdefault(str(attributes.get("stage", "none")), {})
                entries[str(seed)] = str(row.pop(kind))
        rows.append(row)
    variables = {"seed": np.array(seeds)} | stacked(rows)
    return Block(variables, attributes | {"code_version": code_version()} | lost)


def response_block(
    packings: Block,
    stage: str,
    config: dict[str, Any],
    law: ContactLaw,
    sample: Sample,
) -> Block:
    """The block of an observable of `packings`, with the parameters of the packings.

    Args:
        config: the parameters of the stage.
        sample: as in `compute_block`.

    Raises:
        BlockError: the packings have no attribute n or phi, or were made with another law.
    """
    absent = [name for name in ("n", "phi") if name not in packings.attributes]
    if absent:
        raise BlockError(
            f"the packings: expected the attributes n and phi, got no {' and no '.join(absent)}"
        )
    check_law(packings, law)
    point = {name: packings.attributes[name] for name in ("n", "phi")} | {"kt": law.kt}
    attributes = stage_attributes(stage, packings.mapping("config") | config, **point)
    return compute_block(packings.variables["seed"], sample, attributes, packings)


def check_law(block: Block, law: ContactLaw) -> None:
    """Check that samples were made with a contact law, as far as their block states theirs.

    Raises:
        BlockError: they were made with another normal law, or, if not packings, another law.
    """
    made = block.mapping("config")
    known = made.get("law", {}) | ({"normal": made["normal"]} if "normal" in made else {})
    for name, value in known.items():
        if getattr(law, name) != value:
            key = name if name == "kt" else f"contact_law.{name}"
            raise BlockError(
                f"{key}: expected {value!r}, with which these samples were made, "
                f"got {getattr(law, name)!r}"
            )


def stage_attributes(stage: str, config: dict[str, Any], **point: object) -> dict[str, object]:
    """The attributes of a block of a stage."""
    return {"title": f"grainmodes: {stage}", "stage": stage, "config": config, **point}


def stacked(rows: Sequence[dict[str, Any]]) -> dict[str, np.ndarray]:
    """Arrays over all rows; shorter rows, and rows without a name, are filled up."""
    names = list(dict.fromkeys(name for row in rows for name in row)) or ["converged"]
    dtypes = {name: VARIABLES[name].dtype for name in names}
    return {
        name: stack_padded([row.get(name) for row in rows], FILL[dtype], dtype)
        for name, dtype in dtypes.items()
    }
