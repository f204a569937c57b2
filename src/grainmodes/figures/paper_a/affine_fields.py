"""Affine and non-affine displacements of a simulated step strain in one sample: A, Fig. 2.

Left the affine displacement of every grain, right the non-affine displacement that the relaxation
adds, A (10) to (13); both per unit strain. Arrows are displacements, each map on its own scale;
colours are rotations ℓ.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import step_strain_maps
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.grain_rows import field_columns
from grainmodes.figures.shared.map_scale import Scale
from grainmodes.figures.shared.sample_files import jammed_at_point
from grainmodes.figures.shared.selection import Options

PAPER_N = 128
VARIABLES = {"affine": "affine_field", "nonaffine": "nonaffine_field_simulated"}
TITLES = {"affine": "affine", "nonaffine": "non-affine"}

COLUMNS = {
    **step_strain_maps.COLUMNS,
    **field_columns("affine", "d", "affine displacement per unit strain"),
    **field_columns("nonaffine", "d", "non-affine displacement per unit strain; empty: a rattler"),
}


def table(fields: list[Block], options: Options) -> pd.DataFrame:
    """Both fields of every grain of one sample, with the columns `COLUMNS`.

    Raises:
        BlockError: samples are jammed, but none has a simulated field.
        ValueError: no sample has the requested n, phi or kt.
    """
    simulated = VARIABLES["nonaffine"]
    samples = jammed_at_point(fields, options, "affine_fields", simulated, PAPER_N)
    return step_strain_maps.step_strain_rows(samples, options, VARIABLES, COLUMNS)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Displacements of every grain of one sample in a simulated step strain, per unit strain, "
        "A (10) to (13): (a) the affine part, which the step alone makes, (b) the non-affine "
        "part, which the relaxation adds. Arrows: displacements, on a scale of their own in each "
        "map, with the size of one arrow above it. Colours: rotations ℓ = dθ/2. An empty circle "
        "is a grain that carries no load.",
        "the vortices and rotations of (b); in (a) nothing turns, and displacements grow with y "
        "alone.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw two maps, each with arrows on its own scale."""
    figure.set_size_inches(7.0, 3.9)
    figure.set_layout_engine("compressed")
    scales = {prefix: Scale.from_fields(table, (prefix,), arrow=1.0) for prefix in VARIABLES}
    step_strain_maps.draw_two_maps(figure, table, TITLES, scales)
