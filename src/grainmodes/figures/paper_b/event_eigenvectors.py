"""The eigenvector of the smallest eigenvalue of J before and after an event: B, Fig. 4.

Two maps on one scale: arrows are the components (x, y), colours the rotations, of the eigenvector
of norm 1 times N^(1/2).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import event_maps, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.grain_maps import (
    add_colour_bar,
    add_keys,
    draw_map,
    write_map_caption,
)
from grainmodes.figures.shared.grain_rows import COMPONENTS, field_columns
from grainmodes.figures.shared.map_scale import Scale
from grainmodes.figures.shared.selection import Options

SIDES = ("before", "after")
VARIABLES = {side: f"lowest_mode_{side}" for side in SIDES}

COLUMNS = {
    **event_maps.COLUMNS,
    **{
        f"eigenvalue_{side}": (RIGIDITY_UNIT, f"smallest eigenvalue {side} the event")
        for side in SIDES
    },
    **field_columns("before", "1", "its eigenvector before the event, norm 1, times N^(1/2)"),
    **field_columns("after", "1", "the same after it; empty: a grain that carries no load"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """Both eigenvectors, grain by grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    eigenvalues = {f"eigenvalue_{side}": _eigenvalue(side) for side in SIDES}
    rows = event_maps.event_field_rows(event_details, options, VARIABLES, COLUMNS, **eigenvalues)
    fields = [f"{side}_{name}" for side in SIDES for name in COMPONENTS]
    return rows.assign(**{name: rows[name] * np.sqrt(rows["n"]) for name in fields})


def _eigenvalue(side: str) -> Callable[[Block], float]:
    return lambda block: block.variables[f"event_lowest_eigenvalue_{side}"][0, 0]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Eigenvector of the smallest eigenvalue λ_min of the Jacobian just before (a) and just "
        "after (b) a plastic event, of one sample. Arrows: components (x, y), colours: rotations, "
        "of the eigenvector of norm 1 times N^(1/2), both on one scale. An empty circle is a "
        "grain that carries no load.",
        "whether the event changes the softest mode, and whether it is extended or sits on few "
        "grains.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both maps, their titles with the eigenvalues."""
    figure.set_size_inches(7.0, 3.9)
    figure.set_layout_engine("compressed")
    panels = figure.subplots(1, 2, sharey=True)
    scale = Scale.from_fields(table, SIDES, arrow=1.2)
    for index, (axes, side) in enumerate(zip(panels, SIDES, strict=True)):
        draw_map(axes, table, side, scale)
        value = labels.power(table[f"eigenvalue_{side}"].iloc[0], 4)
        labels.name_panel(axes, index, rf"{side}: $\lambda_{{\min}} = {value}$")
        axes.label_outer()
    add_keys(panels[1], scale, "")
    add_colour_bar(figure, list(panels), scale, r"rotation $N^{1/2} R^{\ell}_i$")
    strain = event_maps.event_strain_label(table)
    write_map_caption(figure, table, rf"arrows: $N^{{1/2}} (R^x_i, R^y_i)$, {strain}")
