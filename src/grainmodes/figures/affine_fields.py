"""Affine and non-affine displacements of a simulated step strain in one sample (A, Fig. 2)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures import appearance
from grainmodes.figures.field_rows import (
    GRAINS,
    STEP,
    at_kt,
    at_point,
    described,
    displacements,
    jammed,
    joined,
)
from grainmodes.figures.grain_maps import Scale, add_colour_bar, add_key, draw_map, write_caption
from grainmodes.figures.selection import Options

PAPER_N = 128
VARIABLES = {"affine": "affine_field", "nonaffine": "nonaffine_field_simulated"}
TITLES = {"affine": "affine", "nonaffine": "non-affine"}

COLUMNS = {
    **GRAINS,
    **STEP,
    **described("affine", "d", "affine displacement per unit strain"),
    **described("nonaffine", "d", "non-affine displacement per unit strain; empty: a rattler"),
}


def table(fields: list[Block], options: Options) -> pd.DataFrame:
    """Both fields of every grain of one sample, with the columns `COLUMNS`.

    Raises:
        BlockError: samples are jammed, but none has a simulated field.
        ValueError: no sample has the n, phi or kt asked for.
    """
    samples = jammed(fields, "affine_fields", VARIABLES["nonaffine"])
    shown = at_kt(at_point(samples, options, PAPER_N), options)
    return joined((displacements(block, VARIABLES) for block in shown), COLUMNS)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Two maps, each with arrows on a scale of its own."""
    figure.set_size_inches(7.0, 3.9)
    figure.set_layout_engine("compressed")
    panels = figure.subplots(1, 2, sharey=True)
    for index, (axes, prefix) in enumerate(zip(panels, VARIABLES, strict=True)):
        scale = Scale.of(table, (prefix,), arrow=1.0)
        add_key(axes, draw_map(axes, table, prefix, scale), scale, "$\\,d$")
        appearance.name_panel(axes, index, TITLES[prefix])
        axes.label_outer()
    add_colour_bar(figure, list(panels), scale, r"$d\mathring{\ell}/d\gamma$  $(d)$")
    write_caption(figure, table, "arrows: displacement per unit strain")
