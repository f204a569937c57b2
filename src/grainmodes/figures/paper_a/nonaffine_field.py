"""The non-affine field of one sample by the sum over the modes and by simulation: A, Fig. 3.

(a), (b): maps of both on one scale, arrows per unit strain, colours rotations. (c): all components
in the order of A (33), which is x, y and ℓ of one grain, then of the next; open circles: sum over
the modes, dots within them: simulation; below, the absolute difference of the two.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance, labels, step_strain_maps
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.grain_rows import COMPONENTS, field_columns
from grainmodes.figures.shared.map_scale import Scale
from grainmodes.figures.shared.sample_files import jammed_at_point
from grainmodes.figures.shared.selection import Options

PAPER_N = 1024
VARIABLES = {"theory": "nonaffine_field_mode_sum", "simulation": "nonaffine_field_simulated"}
TITLES = {"theory": "sum over the modes", "simulation": "simulation"}

COLUMNS = {
    **step_strain_maps.COLUMNS,
    **field_columns("theory", "d", "non-affine displacement per unit strain from the modes"),
    **field_columns("simulation", "d", "the same from the relaxed step strains; empty: a rattler"),
}


def table(fields: list[Block], options: Options) -> pd.DataFrame:
    """The field in theory and simulation, grain by grain, with the columns `COLUMNS`.

    Raises:
        BlockError: samples are jammed, but none has a field from the modes.
        ValueError: no sample has the requested n, phi or kt.
    """
    theory = VARIABLES["theory"]
    samples = jammed_at_point(fields, options, "nonaffine_field", theory, PAPER_N)
    return step_strain_maps.step_strain_rows(samples, options, VARIABLES, COLUMNS)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Non-affine displacements of every grain of one sample per unit strain, by both sides of "
        "A (38): (a) the sum over the modes of the Jacobian, (b) a simulated step strain; arrows: "
        "displacements, colours: rotations, both on one scale. (c) All components in the order of "
        "A (33): x, y and ℓ of the first grain, of the second, and so on; open circles: sum over "
        "the modes, dots: simulation; below, the absolute difference of the two.",
        "whether (a) and (b) are one picture, and how many orders of magnitude the difference in "
        "(c) lies below the field.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the maps, and below them the components with their differences."""
    figure.set_size_inches(7.0, 6.4)
    maps, lines = figure.subfigures(2, 1, height_ratios=(3.6, 2.8))
    scale = Scale.from_fields(table, tuple(VARIABLES), arrow=1.3)
    step_strain_maps.draw_two_maps(maps, table, TITLES, dict.fromkeys(VARIABLES, scale))
    above, below = lines.subplots(2, 1, sharex=True, height_ratios=(3, 1.4))
    _draw_components(above, below, *(_in_order(table, prefix) for prefix in VARIABLES))
    lines.align_ylabels()
    labels.name_panel(above, 2, "component by component")


def _in_order(table: pd.DataFrame, prefix: str) -> np.ndarray:
    """The components as one vector (3N,): A (33)."""
    return table[[f"{prefix}_{name}" for name in COMPONENTS]].to_numpy().ravel()


def _draw_components(above: Axes, below: Axes, theory: np.ndarray, simulation: np.ndarray) -> None:
    rank = np.arange(len(theory))
    open_circles = {"ms": 3.6, "mew": 0.4, "fillstyle": "none", "color": appearance.ROTATIONAL}
    dots = {"ms": 1.8, "mew": 0.0, "rasterized": True}
    above.plot(rank, theory, "o", **open_circles, rasterized=True, label=TITLES["theory"])
    above.plot(
        rank, simulation, "o", **dots, color=appearance.TRANSLATIONAL, label=TITLES["simulation"]
    )
    below.plot(rank, np.abs(simulation - theory), "o", **dots, color="0.3")
    largest = 1.1 * np.nanmax(np.abs(theory))
    above.set(ylabel=r"$d\mathring{q}/d\gamma$  $(d)$", ylim=(-largest, largest))
    above.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.1, ncols=2, markerscale=1.5
    )
    below.set(yscale="log", ylabel=r"difference  $(d)$", xlim=(-0.5, len(rank) - 0.5))
    below.set_xlabel("component: $x$, $y$, $\\ell$ of the first grain, of the second, ...")
