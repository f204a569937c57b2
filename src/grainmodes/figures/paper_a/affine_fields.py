"""Affine and non-affine displacements of a simulated step strain in one sample (A, Fig. 2)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import step_strain_maps
from grainmodes.figures.shared.field_rows import at_point, described, jammed
from grainmodes.figures.shared.grain_maps import Scale
from grainmodes.figures.shared.selection import Options

PAPER_N = 128
VARIABLES = {"affine": "affine_field", "nonaffine": "nonaffine_field_simulated"}
TITLES = {"affine": "affine", "nonaffine": "non-affine"}

COLUMNS = {
    **step_strain_maps.COLUMNS,
    **described("affine", "d", "affine displacement per unit strain"),
    **described("nonaffine", "d", "non-affine displacement per unit strain; empty: a rattler"),
}


def table(fields: list[Block], options: Options) -> pd.DataFrame:
    """Both fields of every grain of one sample, with the columns `COLUMNS`.

    Raises:
        BlockError: samples are jammed, but none has a simulated field.
        ValueError: no sample has the n, phi or kt asked for.
    """
    samples = at_point(jammed(fields, "affine_fields", VARIABLES["nonaffine"]), options, PAPER_N)
    return step_strain_maps.rows(samples, options, VARIABLES, COLUMNS)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Two maps, each with arrows on a scale of its own."""
    figure.set_size_inches(7.0, 3.9)
    figure.set_layout_engine("compressed")
    scales = {prefix: Scale.of(table, (prefix,), arrow=1.0) for prefix in VARIABLES}
    step_strain_maps.draw_pair(figure, table, TITLES, scales)
