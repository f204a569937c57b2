"""Two displacement fields of one sample as maps side by side (A, Figs. 2 and 3; B, Fig. 5)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.grain_maps import (
    add_colour_bar,
    add_keys,
    draw_map,
    write_map_caption,
)
from grainmodes.figures.shared.grain_rows import GRAINS, field_values, grain_rows
from grainmodes.figures.shared.map_scale import Scale
from grainmodes.figures.shared.sample_files import at_kt, joined
from grainmodes.figures.shared.selection import Options

COLUMNS = GRAINS | {
    "strain_step": ("1", "size of the simulated step strain, which is applied in both directions"),
}
"""Columns that stand before those of the fields."""


def step_strain_rows(
    samples: list[Block], options: Options, variables: dict[str, str], columns: dict
) -> pd.DataFrame:
    """Every grain of the sample at the requested k_T, else at the largest, with these columns.

    Args:
        variables: prefix of the columns of a field → its variable.
    """
    parts = []
    for block in at_kt(samples, options):
        step = block.mapping("config")["step_strain"]["strain"]
        parts.append(grain_rows(block).assign(strain_step=step, **_fields(block, variables)))
    return joined(parts, columns)


def _fields(block: Block, variables: dict[str, str]) -> dict:
    return {
        column: values
        for prefix, name in variables.items()
        for column, values in field_values(prefix, block.variables[name][0]).items()
    }


def draw_two_maps(
    figure: Figure,
    table: pd.DataFrame,
    titles: dict[str, str],
    scales: dict[str, Scale],
    note: str = "arrows: displacement per unit strain",
) -> None:
    """Draw two maps and the colour bar of the second.

    Args:
        titles: prefix of the columns of a field → title of its map.
        scales: prefix → scale.
    """
    panels = figure.subplots(1, 2, sharey=True)
    for index, (axes, (prefix, title)) in enumerate(zip(panels, titles.items(), strict=True)):
        scale = scales[prefix]
        draw_map(axes, table, prefix, scale)
        add_keys(axes, scale, "$\\,d$")
        labels.name_panel(axes, index, title)
        axes.label_outer()
    add_colour_bar(figure, list(panels), scale, r"$d\mathring{\ell}/d\gamma$  $(d)$")
    write_map_caption(figure, table, note)
