"""The non-affine displacement Δq̊|_c of the grains in an event, B (52), (53): B, Fig. 6.

A map of the sample just after the event: arrows are displacements, colours rotations, both beyond
the affine step from γ_c− to γ_c+.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import event_maps, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.grain_maps import (
    add_colour_bar,
    add_keys,
    draw_map,
    write_map_caption,
)
from grainmodes.figures.shared.grain_rows import field_columns
from grainmodes.figures.shared.map_scale import Scale
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **event_maps.COLUMNS,
    "width": ("1", "width of the bracket of the event"),
    **field_columns("event", "d", "non-affine displacement across the event"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """The displacement, grain by grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    field = {"event": "event_displacement"}
    return event_maps.event_field_rows(event_details, options, field, COLUMNS, width=_width)


def _width(block: Block) -> float:
    before, after = (block.variables[f"event_strain_{side}"][0, 0] for side in ("before", "after"))
    return float(after - before)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Non-affine displacement Δq̊ of every grain in a plastic event, B (52), (53), between the "
        "states at both ends of its bracket. Arrows: displacements, colours: rotations; lengths "
        "and colours are proportional to both up to a hundredth of the largest value and grow as "
        "the logarithm beyond, so that far grains are seen beside near ones; the arrows above the "
        "map show two sizes.",
        "how far from the grain that moves most the event reaches, and whether the rotations "
        "around it form four domains of alternating sign.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw one map, in which lengths and colours grow as the logarithm, with keys above it."""
    figure.set_size_inches(4.2, 4.1)
    figure.set_layout_engine("compressed")
    axes = figure.subplots()
    scale = Scale.compressed(table, "event", arrow=1.8)
    draw_map(axes, table, "event", scale)
    add_keys(axes, scale, "$\\,d$")
    add_colour_bar(figure, [axes], scale, r"$\Delta\mathring{\ell}|_c$  $(d)$")
    width = labels.power(table["width"].iloc[0], 2)
    strain = event_maps.event_strain_label(table)
    where = rf"{strain}, $\gamma_{{c+}} - \gamma_{{c-}} = {width}$"
    write_map_caption(figure, table, rf"arrows: $\Delta\mathring{{r}}|_c$; {where}")
