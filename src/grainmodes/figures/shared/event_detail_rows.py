"""Rows of the figures of one event, from the files of `grainmodes event-detail`."""

from __future__ import annotations

import numpy as np
import pandas as pd

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import at_kt, at_point
from grainmodes.figures.shared.selection import Options

SAMPLE = {
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("k_N", "tangential stiffness k_T"),
    "law": ("", "normal contact law"),
    "seed": ("1", "seed of the sample"),
}
"""Columns that say which sample a row is about."""

BEFORE, AFTER = appearance.ROTATIONAL, appearance.TRANSLATIONAL
"""Colours of the two sides of an event."""


def with_event(blocks: list[Block], options: Options, paper_n: int) -> list[Block]:
    """The sample to show of those that have an event: that of the k_T asked for, or the largest."""
    having = [b for b in blocks if b.variables.get("event_count", [0])[0]]
    return at_kt(at_point(having, options, paper_n), options)


def rows(block: Block, columns: dict[str, str]) -> pd.DataFrame:
    """A row per entry of some variables of one dimension, with the columns `SAMPLE`.

    Args:
        columns: column → variable.
    """
    named = {column: block.variables[name][0] for column, name in columns.items()}
    return pd.DataFrame(sample(block) | named)


def sample(block: Block) -> dict[str, object]:
    """The values of `SAMPLE`."""
    law = block.mapping("config")["law"]["normal"]
    point = {name: block.attributes[name] for name in ("n", "phi", "kt")}
    return point | {"law": law, "seed": block.variables["seed"][0]}


def critical_strain(block: Block) -> float:
    """The middle of the closest bracket."""
    ends = [block.variables[f"event_strain_{side}"][0, 0] for side in ("before", "after")]
    return float(np.mean(ends))


def caption(table: pd.DataFrame, *parts: str) -> str:
    """Which sample is shown, and more."""
    names = [appearance.CONSTANTS[name](table[name].iloc[0]) for name in ("n", "phi", "kt")]
    return ", ".join([*names, f"seed {table['seed'].iloc[0]}", *parts])
