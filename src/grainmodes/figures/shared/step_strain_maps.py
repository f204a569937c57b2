"""Two displacement fields of a step strain in one sample, side by side (A, Figs. 2 and 3)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import GRAINS, at_kt, components, grains, joined
from grainmodes.figures.shared.grain_maps import (
    Scale,
    add_colour_bar,
    add_key,
    draw_map,
    write_caption,
)
from grainmodes.figures.shared.selection import Options

COLUMNS = GRAINS | {
    "strain_step": ("1", "size of the simulated step strain, taken to both sides"),
}
"""Columns that stand before those of the fields."""


def rows(
    samples: list[Block], options: Options, variables: dict[str, str], columns: dict
) -> pd.DataFrame:
    """Every grain of the sample at the k_T asked for, else at the largest, with these columns.

    Args:
        variables: prefix of the columns of a field → its variable.
    """
    shown = at_kt(samples, options)
    return joined((_displacements(block, variables) for block in shown), columns)


def _displacements(block: Block, variables: dict[str, str]) -> pd.DataFrame:
    found = grains(block).assign(strain_step=block.mapping("config")["step_strain"]["strain"])
    for prefix, name in variables.items():
        found = found.assign(**components(prefix, block.variables[name][0]))
    return found


def draw_pair(
    figure: Figure,
    table: pd.DataFrame,
    titles: dict[str, str],
    scales: dict[str, Scale],
    note: str = "arrows: displacement per unit strain",
) -> None:
    """Two maps and the colour bar of the second.

    Args:
        titles: prefix of the columns of a field → title of its map.
        scales: prefix → scale.
    """
    panels = figure.subplots(1, 2, sharey=True)
    for index, (axes, (prefix, title)) in enumerate(zip(panels, titles.items(), strict=True)):
        scale = scales[prefix]
        add_key(axes, draw_map(axes, table, prefix, scale), scale, "$\\,d$")
        appearance.name_panel(axes, index, title)
        axes.label_outer()
    add_colour_bar(figure, list(panels), scale, r"$d\mathring{\ell}/d\gamma$  $(d)$")
    write_caption(figure, table, note)
