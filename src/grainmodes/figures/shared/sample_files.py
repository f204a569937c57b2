"""Files of single samples, as three stages write them, and the samples that a figure shows."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from grainmodes.dataset.files import Block, BlockError, content_of, read_block
from grainmodes.figures.shared.selection import Options, largest_or
from grainmodes.parameters.law import ContactLaw

if TYPE_CHECKING:
    import xarray as xr

CONTENTS = {"fields": "fields", "event_detail": "event details", "release": "releases"}
"""Stage that writes single samples → what its files hold."""


def read_samples(paths: list[str | Path], stage: str = "fields") -> list[Block]:
    """Read the files of single samples that a stage wrote.

    Raises:
        BlockError: a file is not readable, is of another stage, or repeats a point of another file.
    """
    found: dict[tuple, tuple[Path, Block]] = {}  # by point and seeds
    for path in paths:
        block = read_block(path)
        if block.attributes.get("stage") != stage:
            raise BlockError(f"{path}: expected {CONTENTS[stage]}, got {content_of(block)}")
        samples = tuple(block.attributes[name] for name in ("n", "phi", "kt"))
        samples += tuple(block.variables["seed"].tolist())
        if samples in found:
            raise BlockError(f"{path}: duplicate n, phi and kt, {found[samples][0]} holds them too")
        found[samples] = path, block
    return [block for _, block in found.values()]


def jammed_at_point(
    blocks: list[Block], options: Options, figure: str, variable: str, paper_n: int
) -> list[Block]:
    """The jammed samples with a variable, at the N and φ of `at_point`.

    Raises:
        BlockError: samples are jammed, but none has this variable.
        ValueError: as `at_point`.
    """
    jammed = [block for block in blocks if block.variables.get("jammed", [0])[0] == 1]
    complete = [block for block in jammed if variable in block.variables]
    if jammed and not complete:
        raise BlockError(f"figure {figure}: no sample holds {variable}")
    return at_point(complete, options, paper_n)


def at_point(blocks: list[Block], options: Options, paper_n: int) -> list[Block]:
    """The samples of the requested N and φ; else of the N nearest to the paper's, and of the
    largest φ.

    Raises:
        ValueError: no sample has the requested N or φ.
    """
    blocks = _at(blocks, "n", options.n, lambda sizes: _nearest(sizes, paper_n))
    return _at(blocks, "phi", options.phi, np.max)


def at_kt(blocks: list[Block], options: Options) -> list[Block]:
    """The samples of the requested k_T; else of the largest.

    Raises:
        ValueError: no sample has the requested k_T, or several are requested.
    """
    return _at(blocks, "kt", options.one_kt(), np.max)


def _at(blocks: list[Block], name: str, requested: float | None, choose: Callable) -> list[Block]:
    values = np.unique([block.attributes[name] for block in blocks])
    if not len(values):
        return []
    wanted = choose(values) if requested is None else largest_or(requested, values, name)
    return [block for block in blocks if block.attributes[name] == wanted]


def _nearest(sizes: np.ndarray, wanted: float) -> float:
    """The N with the smallest ratio to the wanted one."""
    return sizes[np.argmin(np.abs(np.log(sizes / wanted)))]


def point_of(block: Block) -> dict[str, float]:
    """N, φ and k_T of a block, with the columns `columns.POINT`."""
    return {name: block.attributes[name] for name in ("n", "phi", "kt")}


def law_of(block: Block) -> ContactLaw:
    """The contact law of a block."""
    return ContactLaw(**block.mapping("config").get("law", {}))


def compressed_with_friction(source: list[Block] | xr.Dataset, table: pd.DataFrame) -> bool:
    """Whether the packings of a table of plotted numbers were compressed with friction.

    All packings of one N are of one kind.
    """
    sizes = set(table["n"])
    if isinstance(source, list):
        shown = [block for block in source if int(block.attributes["n"]) in sizes]
        return any("frictional_compression" in block.mapping("config") for block in shown)
    if "compressed_with_friction" not in source:
        return False
    of_table = source["n"].isin(list(sizes))
    return bool((source["compressed_with_friction"].where(of_table) == 1).any())


def joined(parts: Iterable[pd.DataFrame], columns: Iterable[str]) -> pd.DataFrame:
    """The rows of several samples below each other, with these columns in this order."""
    parts, columns = list(parts), list(columns)
    return pd.concat(parts, ignore_index=True)[columns] if parts else pd.DataFrame(columns=columns)
