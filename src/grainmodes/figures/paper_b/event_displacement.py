"""What the grains do in an event beyond the affine step (B, Fig. 6)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance, event_maps
from grainmodes.figures.shared.field_rows import described
from grainmodes.figures.shared.grain_maps import Scale, add_colour_bar, draw_map, write_caption
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **event_maps.COLUMNS,
    "width": ("1", "width of the bracket of the event"),
    **described("event", "d", "non-affine displacement across the event"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """The displacement, grain by grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi or kt asked for.
    """
    field = {"event": "event_displacement"}
    return event_maps.rows(event_details, options, field, COLUMNS, width=_width)


def _width(block: Block) -> float:
    before, after = (block.variables[f"event_strain_{side}"][0, 0] for side in ("before", "after"))
    return float(after - before)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """One map, with the size of its arrows in the caption."""
    figure.set_size_inches(4.2, 4.1)
    figure.set_layout_engine("compressed")
    axes = figure.subplots()
    scale = Scale.of(table, ("event",), arrow=1.2)
    arrows = draw_map(axes, table, "event", scale)
    label = rf"${appearance.power(scale.key)}\,d$"
    axes.quiverkey(arrows, 0.76, 1.035, scale.key, label, labelpos="E", labelsep=0.05)
    add_colour_bar(figure, [axes], scale, r"$\Delta\mathring{\ell}|_c$  $(d)$")
    width = appearance.power(float(f"{table['width'].iloc[0]:.2g}"))
    where = rf"{event_maps.at_event(table)}, $\gamma_{{c+}} - \gamma_{{c-}} = {width}$"
    write_caption(figure, table, rf"arrows: $\Delta\mathring{{r}}|_c$; {where}")
