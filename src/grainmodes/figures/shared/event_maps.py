"""Maps of the fields of one event (B, Figs. 4 to 6)."""

from __future__ import annotations

import pandas as pd

from grainmodes.dataset.files import Block
from grainmodes.figures.shared.event_detail_rows import critical_strain, with_event
from grainmodes.figures.shared.field_rows import GRAINS, components, grains, joined
from grainmodes.figures.shared.selection import Options

PAPER_N = 1024

COLUMNS = GRAINS | {"critical_strain": ("1", "strain of the event")}
"""Columns that stand before those of the fields."""


def rows(
    event_details: list[Block],
    options: Options,
    variables: dict[str, str],
    columns: dict,
    **scalars,
) -> pd.DataFrame:
    """Every grain of the sample shown, where it is just after the event, with these columns.

    Args:
        variables: prefix of the columns of a field → its variable.
        scalars: column → what it is of a block.

    Raises:
        ValueError: no sample has the n, phi or kt asked for.
    """
    parts = []
    for block in with_event(event_details, options, PAPER_N):
        found = grains(block).assign(critical_strain=critical_strain(block))
        for prefix, name in variables.items():
            field = block.variables[name][0]
            found = found.assign(**components(prefix, field.reshape(-1, 3)))
        parts.append(found.assign(**{name: of(block) for name, of in scalars.items()}))
    return joined(parts, columns)


def at_event(table: pd.DataFrame) -> str:
    """The strain of the event, in words of a caption."""
    return rf"$\gamma_c = {table['critical_strain'].iloc[0]:.6g}$"
