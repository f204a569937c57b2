"""Rows of the figures of single samples: one per grain, from the files of `grainmodes fields` and
`grainmodes event-detail`."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
import pandas as pd

from grainmodes.dataset.files import Block, BlockError, read_block
from grainmodes.figures.shared.selection import Options, largest_or

GRAINS = {
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("k_N", "tangential stiffness k_T"),
    "seed": ("1", "seed of the sample"),
    "box_length": ("d", "side L of the periodic box"),
    "strain": ("1", "shear strain of the box"),
    "grain": ("1", "number of the grain"),
    "x": ("d", "its place"),
    "y": ("d", "its place"),
    "diameter": ("d", "its diameter"),
}
"""Columns that say which grain a row is about."""

NAMES = {"fields": "fields", "event_detail": "event details", "release": "releases"}
"""Stages that keep the grains of samples, and what their files hold."""

COMPONENTS = ("x", "y", "rotation")
"""Names of the components (x, y, ℓ), ℓ = d θ / 2."""


def described(prefix: str, unit: str, meaning: str) -> dict[str, tuple[str, str]]:
    """The columns of a field, with unit and meaning."""
    named = zip(COMPONENTS, ("x", "y", "rotation l = d theta / 2"), strict=True)
    return {f"{prefix}_{name}": (unit, f"{meaning}, {words}") for name, words in named}


def read(paths: list[str | Path], needed: str = "fields") -> list[Block]:
    """The files of single samples that a stage made.

    Raises:
        BlockError: a file is not readable, holds something else, or a point that another holds.
    """
    found: dict[tuple, tuple[Path, Block]] = {}  # by point and seeds
    for path in paths:
        block = read_block(path)
        stage = block.attributes.get("stage", "something else")
        if stage != needed:
            raise BlockError(f"{path}: expected {NAMES[needed]}, got {stage}")
        samples = tuple(block.attributes[name] for name in ("n", "phi", "kt"))
        samples += tuple(block.variables["seed"].tolist())
        if samples in found:
            raise BlockError(f"{path}: duplicate n, phi and kt, {found[samples][0]} holds them too")
        found[samples] = path, block
    return [block for _, block in found.values()]


def jammed(blocks: list[Block], figure: str, name: str) -> list[Block]:
    """Those of the samples that are jammed, all with the variable `name`.

    Raises:
        BlockError: samples are jammed, but none has this variable.
    """
    rigid = [block for block in blocks if block.variables.get("jammed", [0])[0] == 1]
    having = [block for block in rigid if name in block.variables]
    if rigid and not having:
        raise BlockError(f"figure {figure}: no sample holds {name}")
    return having


def at_point(blocks: list[Block], options: Options, paper_n: int) -> list[Block]:
    """The samples of the N and φ asked for: else of the N nearest to A's, and of the largest φ."""
    blocks = _at(blocks, "n", options.n, lambda values: _nearest(values, paper_n))
    return _at(blocks, "phi", options.phi, np.max)


def at_kt(blocks: list[Block], options: Options) -> list[Block]:
    """The samples of the first k_T asked for, else of the largest."""
    return _at(blocks, "kt", options.kt and options.kt[0], np.max)


def _at(blocks: list[Block], name: str, asked: float | None, choose: Callable) -> list[Block]:
    values = np.unique([block.attributes[name] for block in blocks])
    if not len(values):
        return []
    wanted = choose(values) if asked is None else largest_or(asked, values, name)
    return [block for block in blocks if block.attributes[name] == wanted]


def _nearest(values: np.ndarray, wanted: float) -> float:
    return values[np.argmin(np.abs(np.log(values / wanted)))]


def grains(block: Block) -> pd.DataFrame:
    """A row for every grain of the first sample of a block, with the columns `GRAINS`."""
    sample = {name: array[0] for name, array in block.variables.items()}
    x, y = sample["position"].T
    return pd.DataFrame(
        {
            **{name: block.attributes[name] for name in ("n", "phi", "kt")},
            **{name: sample[name] for name in ("seed", "box_length", "strain")},
            "grain": np.arange(len(x)),
            "x": x,
            "y": y,
            "diameter": sample["diameter"],
        }
    )


def components(prefix: str, field: np.ndarray) -> dict[str, np.ndarray]:
    """A field (N, 3) as the columns of its prefix."""
    return {f"{prefix}_{name}": field[:, k] for k, name in enumerate(COMPONENTS)}


def joined(parts: Iterable[pd.DataFrame], columns: Iterable[str]) -> pd.DataFrame:
    """The rows of several samples below each other, with these columns in this order."""
    parts, columns = list(parts), list(columns)
    return pd.concat(parts, ignore_index=True)[columns] if parts else pd.DataFrame(columns=columns)
