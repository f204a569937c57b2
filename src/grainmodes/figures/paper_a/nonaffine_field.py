"""The non-affine field of one sample: mode sum, simulation, and component by component (A, Fig. 3).

The components stand in the order of A (33): x, y and ℓ of one grain, then of the next.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance, step_strain_maps
from grainmodes.figures.shared.field_rows import COMPONENTS, at_point, described, jammed
from grainmodes.figures.shared.grain_maps import Scale
from grainmodes.figures.shared.selection import Options

PAPER_N = 1024
VARIABLES = {"theory": "nonaffine_field_mode_sum", "simulation": "nonaffine_field_simulated"}
TITLES = {"theory": "sum over the modes", "simulation": "simulation"}

COLUMNS = {
    **step_strain_maps.COLUMNS,
    **described("theory", "d", "non-affine displacement per unit strain from the modes"),
    **described("simulation", "d", "the same from the relaxed step strains; empty: a rattler"),
}


def table(fields: list[Block], options: Options) -> pd.DataFrame:
    """The field in theory and simulation, grain by grain, with the columns `COLUMNS`.

    Raises:
        BlockError: samples are jammed, but none has a field from the modes.
        ValueError: no sample has the n, phi or kt asked for.
    """
    samples = at_point(jammed(fields, "nonaffine_field", VARIABLES["theory"]), options, PAPER_N)
    return step_strain_maps.rows(samples, options, VARIABLES, COLUMNS)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a), (b): maps on one scale; (c): every component; below it, what the two differ by."""
    figure.set_size_inches(7.0, 6.4)
    maps, lines = figure.subfigures(2, 1, height_ratios=(3.6, 2.8))
    scale = Scale.of(table, tuple(VARIABLES), arrow=1.3)
    step_strain_maps.draw_pair(maps, table, TITLES, dict.fromkeys(VARIABLES, scale))
    above, below = lines.subplots(2, 1, sharex=True, height_ratios=(3, 1.4))
    _components(above, below, *(_in_order(table, prefix) for prefix in VARIABLES))
    lines.align_ylabels()
    appearance.name_panel(above, 2, "component by component")


def _in_order(table: pd.DataFrame, prefix: str) -> np.ndarray:
    """The components as one vector (3N,): A (33)."""
    return table[[f"{prefix}_{name}" for name in COMPONENTS]].to_numpy().ravel()


def _components(above: Axes, below: Axes, theory: np.ndarray, simulation: np.ndarray) -> None:
    """Open circles: theory; dots within them: simulation; logarithmic: their difference."""
    rank = np.arange(len(theory))
    open_circles = {"ms": 3.6, "mew": 0.4, "fillstyle": "none", "color": appearance.ROTATIONAL}
    dots = {"ms": 1.8, "mew": 0.0, "rasterized": True}
    above.plot(rank, theory, "o", **open_circles, rasterized=True, label=TITLES["theory"])
    above.plot(
        rank, simulation, "o", **dots, color=appearance.TRANSLATIONAL, label=TITLES["simulation"]
    )
    below.plot(rank, np.abs(simulation - theory), "o", **dots, color="0.3")
    largest = 1.35 * np.nanmax(np.abs(theory))
    above.set(ylabel=r"$d\mathring{q}/d\gamma$  $(d)$", ylim=(-largest, largest))
    above.legend(loc="upper right", ncols=2, markerscale=1.5)
    below.set(yscale="log", ylabel=r"difference  $(d)$", xlim=(-0.5, len(rank) - 0.5))
    below.set_xlabel("component: $x$, $y$, $\\ell$ of the first grain, of the second, ...")
