"""Rows of the figures of one event, and its sample, from files of `grainmodes event-detail`."""

from __future__ import annotations

import numpy as np
import pandas as pd

from grainmodes.dataset.files import Block
from grainmodes.figures.shared.columns import LAW, POINT, SEED, law_values
from grainmodes.figures.shared.sample_files import at_kt, at_point, law_of, point_of
from grainmodes.figures.shared.selection import Options

SAMPLE = POINT | LAW | SEED
"""Columns that say which sample a row is about."""


def sample_with(count: str, blocks: list[Block], options: Options, paper_n: int) -> list[Block]:
    """The converged sample to show whose variable `count` is above 0; none where it is 0 in all.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    complete = [
        block
        for block in blocks
        if block.variables["converged"][0] == 1 and block.variables.get(count, [0])[0]
    ]
    return at_kt(at_point(complete, options, paper_n), options)


def rows_from_variables(block: Block, columns: dict[str, str]) -> pd.DataFrame:
    """A row per entry of some variables of one dimension, with the columns `SAMPLE`.

    Args:
        columns: column → variable.
    """
    values = {column: block.variables[name][0] for column, name in columns.items()}
    return pd.DataFrame(identity(block) | values)


def identity(block: Block) -> dict[str, object]:
    """The values of the columns `SAMPLE`."""
    seed = {"seed": block.variables["seed"][0]}
    return point_of(block) | law_values(law_of(block)) | seed


def critical_strain(block: Block) -> float:
    """γ_c, the middle of the closest bracket of the event."""
    ends = [block.variables[f"event_strain_{side}"][0, 0] for side in ("before", "after")]
    return float(np.mean(ends))
