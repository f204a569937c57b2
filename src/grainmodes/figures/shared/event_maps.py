"""Maps of the fields of one event (B, Figs. 4 to 6)."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd

from grainmodes.dataset.files import Block
from grainmodes.figures.shared.event_rows import critical_strain, sample_with
from grainmodes.figures.shared.grain_rows import GRAINS, field_values, grain_rows
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

PAPER_N = 1024

COLUMNS = GRAINS | {"critical_strain": ("1", "strain of the event")}
"""Columns that stand before those of the fields."""


def event_field_rows(
    event_details: list[Block],
    options: Options,
    variables: dict[str, str],
    columns: dict,
    **scalars: Callable[[Block], float],
) -> pd.DataFrame:
    """Every grain of the sample shown, at its place just after the event, with these columns.

    Args:
        variables: prefix of the columns of a field → its variable.
        scalars: column → function that finds its one value in the block.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    parts = []
    for block in sample_with("event_count", event_details, options, PAPER_N):
        rows = grain_rows(block).assign(critical_strain=critical_strain(block))
        for prefix, name in variables.items():
            field = block.variables[name][0].reshape(-1, 3)
            rows = rows.assign(**field_values(prefix, field))
        parts.append(rows.assign(**{name: find(block) for name, find in scalars.items()}))
    return joined(parts, columns)


def event_strain_label(table: pd.DataFrame) -> str:
    """The strain of the event, as a formula of a caption."""
    return rf"$\gamma_c = {table['critical_strain'].iloc[0]:.6g}$"
