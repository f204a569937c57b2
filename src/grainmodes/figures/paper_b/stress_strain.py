"""Stress against strain in one sample, simulation and theory from step to step: B, Figs. 1 and 8.

(a) all strains, (b) around the largest drop of the stress, (c) the smallest strains, (d) around the
first event, without the slope before it: a small drop is invisible in (c). Dots: states of the
simulation; lines: linear response from every state to the next; short bars at the bottom:
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
    earliness,
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

RANGE_BEYOND_EVENT = 1.25
"""Largest strain of panel (c) of a sample whose first event is late, in units of that strain."""

CLOSE_UP = 2.5e-4
"""Range of strain of panel (d) on either side of the first event."""

NOTE = "dots: simulation, lines: theory, from every state to the next; bars: plastic events"


def table(ensemble, options: Options) -> pd.DataFrame:
    """Both stresses of every state, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the requested n, phi, kt or seed.
    """
    curve, rows = one_curve(ensemble, options, COLUMNS, prefer=earliness)
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
        "around the largest drop, which is the grey band of (a), (c) the smallest strains, (d) "
        "around the first event, without the slope just before it, in units of 1e-6. Dots: "
        "states of the simulation; lines: linear response from every state to the next, B (51); "
        "short bars at the bottom: plastic events.",
        "whether each line ends at the next dot, except in an event.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the panels; without an event only all strains and the smallest ones."""
    figure.set_size_inches(7.0, 4.6)
    has_event = bool(table["event"].any())
    grid = figure.add_gridspec(2, 3 if has_event else 1)
    whole = figure.add_subplot(grid[0, :])
    below = [figure.add_subplot(grid[1, k]) for k in range(3 if has_event else 1)]
    _draw_curve(whole, table, 2.2)
    titles = ["all strains", "small strains"]
    if has_event:
        around = _around_largest_drop(table)
        _draw_curve(below[0], around, 2.5)
        low, high = around["strain"].iloc[[0, -1]]
        whole.axvspan(low, high, color="0.88", linewidth=0, zorder=0)
        _draw_close_up(below[2], table)
        titles = ["all strains", "at the largest drop", "small strains", "at the first event"]
    small = below[1] if has_event else below[0]
    _draw_curve(small, table[at_small_strain(table["strain"], _end_of_small(table))], 2.5)
    for index, (axes, title) in enumerate(zip((whole, *below), titles, strict=True)):
        labels.name_panel(axes, index, title)
        axes.set_xlabel(axes.get_xlabel() or r"$\gamma$")
        axes.set_ylabel(axes.get_ylabel() or labels.modulus_label(r"$\sigma$", table))
    labels.write_sample_caption(figure, table, NOTE)


def _end_of_small(table: pd.DataFrame) -> float:
    """B's 0.002, or beyond the first event of a sample that has it later."""
    first = table["strain"][table["event"] == 1].min()
    return max(SMALL_STRAIN, RANGE_BEYOND_EVENT * first) if first > 0.0 else SMALL_STRAIN


def _draw_close_up(axes: Axes, table: pd.DataFrame) -> None:
    """Draw σ near the first event without the slope before it, which would hide a small drop."""
    last = int(np.argmax(table["event"].to_numpy() == 1)) - 1
    before, after = table.iloc[last], table.iloc[last + 1]
    rise = after["stress_theory"] - before["stress"]
    slope = rise / (after["strain"] - before["strain"])
    x = table["strain"] - before["strain"]
    flat = {
        name: 1e6 * (table[name] - before["stress"] - slope * x)
        for name in ("stress", "stress_theory")
    }
    _draw_curve(axes, table.assign(strain=1e4 * x, **flat)[x.abs() <= CLOSE_UP], 3.0)
    axes.set_xlabel(r"$(\gamma - \gamma_c) \times 10^4$")
    axes.set_ylabel(r"$[\sigma - \sigma_c - g_c (\gamma - \gamma_c)] \times 10^6$")


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
