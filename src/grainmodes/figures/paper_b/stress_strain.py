"""Stress against strain in one sample, simulation and theory from step to step (B, Figs. 1, 8).

(a) all strains, (b) about the largest drop of stress, (c) the smallest strains.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.appearance import ROTATIONAL
from grainmodes.figures.shared.rigidity_rows import UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_points import EVENTS, SAMPLE, SMALL, name_sample, sample

COLUMNS = SAMPLE | {
    "strain": ("1", "strain of a state"),
    "stress": (UNIT, "(sigma_xy + sigma_yx) / 2 in the simulation"),
    "stress_theory": (UNIT, "the same from the state before, sigma + g times the step"),
    "event": ("1", "1: a plastic event lies in the step that leads to this state"),
}
AROUND = 12
"""Steps on either side of the largest drop that panel b shows."""

NOTE = "dots: simulation, lines: theory, from every state to the next; bars: plastic events"


def table(ensemble, options: Options) -> pd.DataFrame:
    """Both stresses of every state, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the n, phi, kt or seed asked for.
    """
    curve, rows = sample(ensemble, options, COLUMNS)
    if curve is None:
        return rows
    return rows.assign(
        strain=curve.strain,
        stress=curve.stress,
        stress_theory=np.concatenate([[np.nan], curve.stress[:-1] + curve.predicted_change]),
        event=np.concatenate([[0], curve.event.astype(int)]),
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Three panels."""
    figure.set_size_inches(7.0, 4.6)
    grid = figure.add_gridspec(2, 2)
    whole = figure.add_subplot(grid[0, :])
    drop, small = (figure.add_subplot(grid[1, k]) for k in (0, 1))
    _draw_curve(whole, table, 2.2)
    around = _around_largest_drop(table)
    _draw_curve(drop, around, 2.5)
    _draw_curve(small, table[table["strain"] <= SMALL * (1 + 1e-9)], 2.5)
    if table["event"].any():
        low, high = around["strain"].iloc[[0, -1]]
        whole.axvspan(low, high, color="0.88", linewidth=0, zorder=0)
    titles = ("all strains", "about the largest drop", rf"$\gamma \leq {SMALL:g}$")
    for index, (axes, title) in enumerate(zip((whole, drop, small), titles, strict=True)):
        appearance.name_panel(axes, index, title)
        axes.set(xlabel=r"$\gamma$", ylabel=appearance.modulus_label(r"$\sigma$", table))
    name_sample(figure, table, NOTE)


def _draw_curve(axes: Axes, of: pd.DataFrame, size: float) -> None:
    axes.plot(of["strain"], of["stress"], "o", color="0.15", markersize=size, mew=0, zorder=2)
    axes.plot(*_theory(of), color=ROTATIONAL, linewidth=0.8, zorder=3)
    for strain in of.loc[of["event"] == 1, "strain"]:
        axes.axvline(strain, ymax=0.06, color=EVENTS, linewidth=0.7, zorder=1)


def _theory(of: pd.DataFrame) -> tuple[np.ndarray, np.ndarray]:
    """Lines from every state to what theory makes of it in a step, broken in between."""
    strain, gap = of["strain"].to_numpy(), np.full(max(len(of) - 1, 0), np.nan)
    ends = of["stress"].to_numpy()[:-1], of["stress_theory"].to_numpy()[1:], gap
    return np.stack([strain[:-1], strain[1:], gap], 1).ravel(), np.stack(ends, 1).ravel()


def _around_largest_drop(table: pd.DataFrame) -> pd.DataFrame:
    """The states near the event in which σ falls most; near the first state where there is none."""
    fall = (table["stress"].diff()).where(table["event"] == 1, np.inf)
    centre = table["strain"].loc[fall.idxmin()]
    width = AROUND * table["strain"].diff().max()
    return table[(table["strain"] - centre).abs() <= width]
