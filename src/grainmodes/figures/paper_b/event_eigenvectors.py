"""The eigenvector of the lowest eigenvalue on both sides of an event (B, Fig. 4)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance, event_maps
from grainmodes.figures.shared.field_rows import COMPONENTS, described
from grainmodes.figures.shared.grain_maps import (
    Scale,
    add_colour_bar,
    add_key,
    draw_map,
    write_caption,
)
from grainmodes.figures.shared.selection import Options

SIDES = ("before", "after")
VARIABLES = {side: f"lowest_mode_{side}" for side in SIDES}

COLUMNS = {
    **event_maps.COLUMNS,
    **{f"eigenvalue_{side}": ("k_N", f"smallest eigenvalue {side} the event") for side in SIDES},
    **described("before", "1", "its eigenvector before the event, norm 1, times N^(1/2)"),
    **described("after", "1", "the same after it; empty: a grain that carries no load"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """Both eigenvectors, grain by grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi or kt asked for.
    """
    of = {f"eigenvalue_{side}": _eigenvalue(side) for side in SIDES}
    found = event_maps.rows(event_details, options, VARIABLES, COLUMNS, **of)
    fields = [f"{side}_{name}" for side in SIDES for name in COMPONENTS]
    return found.assign(**{name: found[name] * np.sqrt(found["n"]) for name in fields})


def _eigenvalue(side: str):
    return lambda block: block.variables[f"event_lowest_eigenvalue_{side}"][0, 0]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Two maps on one scale."""
    figure.set_size_inches(7.0, 3.9)
    figure.set_layout_engine("compressed")
    panels = figure.subplots(1, 2, sharey=True)
    scale = Scale.of(table, SIDES, arrow=1.2)
    for index, (axes, side) in enumerate(zip(panels, SIDES, strict=True)):
        arrows = draw_map(axes, table, side, scale)
        value = appearance.power(float(f"{table[f'eigenvalue_{side}'].iloc[0]:.4g}"))
        appearance.name_panel(axes, index, rf"{side}: $\lambda_{{\min}} = {value}$")
        axes.label_outer()
    add_key(panels[1], arrows, scale, "")
    add_colour_bar(figure, list(panels), scale, r"rotation $N^{1/2} R^{\ell}_i$")
    note = rf"arrows: $N^{{1/2}} (R^x_i, R^y_i)$, {event_maps.at_event(table)}"
    write_caption(figure, table, note)
