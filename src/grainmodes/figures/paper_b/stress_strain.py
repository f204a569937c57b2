"""Stress against strain in one sample, simulation and theory from step to step: B, Figs. 1 and 8.

(a) all strains, (b) around the largest drop of the stress, (c) the smallest strains. Dots: states
of the simulation; lines: linear response from every state to the next; short bars at the bottom:
plastic events. The grey band in (a) is the range of (b).
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import RED, ROTATIONAL
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_samples import (
    SAMPLE,
    SMALL_STRAIN,
    at_small_strain,
    one_curve,
)

COLUMNS = SAMPLE | {
    "strain": ("1", "strain of a state"),
    "stress": (RIGIDITY_UNIT, "(sigma_xy + sigma_yx) / 2 in the simulation"),
    "stress_theory": (RIGIDITY_UNIT, "the same from the state before, sigma + g times the step"),
    "event": ("1", "1: a plastic event lies in the step that leads to this state"),
}
STEPS_AROUND_DROP = 12
"""Steps on either side of the largest drop that panel (b) shows."""

NOTE = "dots: simulation, lines: theory, from every state to the next; bars: plastic events"


def table(ensemble, options: Options) -> pd.DataFrame:
    """Both stresses of every state, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the requested n, phi, kt or seed.
    """
    curve, rows = one_curve(ensemble, options, COLUMNS)
    if curve is None:
        return rows
    return rows.assign(
        strain=curve.strain,
        stress=curve.stress,
        stress_theory=np.concatenate([[np.nan], curve.stress[:-1] + curve.predicted_change]),
        event=np.concatenate([[0], curve.event.astype(int)]),
    )


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Shear stress σ = (σ_xy + σ_yx)/2 against strain γ in one sample: (a) all strains, (b) "
        "around the largest drop, which is the grey band of (a), (c) the smallest strains. Dots: "
        "states of the simulation; lines: linear response from every state to the next, B (51); "
        "short bars at the bottom: plastic events.",
        "whether each line ends at the next dot, except in an event.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the three panels."""
    figure.set_size_inches(7.0, 4.6)
    grid = figure.add_gridspec(2, 2)
    whole = figure.add_subplot(grid[0, :])
    drop, small = (figure.add_subplot(grid[1, k]) for k in (0, 1))
    _draw_curve(whole, table, 2.2)
    around = _around_largest_drop(table)
    _draw_curve(drop, around, 2.5)
    _draw_curve(small, table[at_small_strain(table["strain"])], 2.5)
    if table["event"].any():
        low, high = around["strain"].iloc[[0, -1]]
        whole.axvspan(low, high, color="0.88", linewidth=0, zorder=0)
    titles = ("all strains", "about the largest drop", rf"$\gamma \leq {SMALL_STRAIN:g}$")
    for index, (axes, title) in enumerate(zip((whole, drop, small), titles, strict=True)):
        labels.name_panel(axes, index, title)
        axes.set(xlabel=r"$\gamma$", ylabel=labels.modulus_label(r"$\sigma$", table))
    labels.write_sample_caption(figure, table, NOTE)


def _draw_curve(axes: Axes, states: pd.DataFrame, size: float) -> None:
    style = {"color": "0.15", "markersize": size, "mew": 0, "zorder": 2}
    axes.plot(states["strain"], states["stress"], "o", **style)
    axes.plot(*_theory_lines(states), color=ROTATIONAL, linewidth=0.8, zorder=3)
    for strain in states.loc[states["event"] == 1, "strain"]:
        axes.axvline(strain, ymax=0.06, color=RED, linewidth=0.7, zorder=1)


def _theory_lines(states: pd.DataFrame) -> tuple[np.ndarray, np.ndarray]:
    """Lines from every state to what theory predicts for the next, separated by NaN."""
    strain, gap = states["strain"].to_numpy(), np.full(max(len(states) - 1, 0), np.nan)
    ends = states["stress"].to_numpy()[:-1], states["stress_theory"].to_numpy()[1:], gap
    return np.stack([strain[:-1], strain[1:], gap], 1).ravel(), np.stack(ends, 1).ravel()


def _around_largest_drop(table: pd.DataFrame) -> pd.DataFrame:
    """The states near the event in which σ falls most; near the first state without an event."""
    change = table["stress"].diff().where(table["event"] == 1, np.inf)
    centre = table["strain"].loc[change.idxmin()]
    width = STEPS_AROUND_DROP * table["strain"].diff().max()
    return table[(table["strain"] - centre).abs() <= width]
