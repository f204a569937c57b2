"""Rigidity and smallest eigenvalue of one sample at small strain, through an event: B, Fig. 7.

Above g: line and open symbols by linear response, dots as slope of the stress in steps without a
plastic event. Below λ_min of the Jacobian. Left all strains, where the line joins all states and a
state in each of some cells of strain has a symbol; right every state around the first event, which
is B's inset. Vertical lines mark events. The strains are B's, or reach beyond the first event of a
sample that has it later.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.curves import Curve
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
    "rigidity": (RIGIDITY_UNIT, "(g_xy + g_yx) / 2 by linear response"),
    "rigidity_simulated": (
        RIGIDITY_UNIT,
        "slope of the simulated stress in the step to the next state",
    ),
    "lowest_eigenvalue": (RIGIDITY_UNIT, "smallest eigenvalue of the Jacobian but translations"),
    "event": ("1", "1: a plastic event lies in the step to the next state"),
}
RANGE_BEYOND_EVENT = 1.25
"""Largest strain shown of a sample whose first event is late, in units of the strain of the
event."""

NOTE = (
    "open: linear response, dots: slope of the stress in steps without plastic event; bars: events"
)

MAX_SYMBOLS = 40
"""Number of states that have symbols over all strains, where those of all would merge."""

STEPS_AROUND_EVENT = 5
"""Longest steps on either side of the first event that the close-up shows."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """g, Δσ/Δγ and λ_min of the states at small strain, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the requested n, phi, kt or seed.
    """
    curve, rows = one_curve(ensemble, options, COLUMNS, prefer=earliness)
    if curve is None:
        return rows
    slope = np.where(curve.event, np.nan, curve.stress_change / curve.step)
    rows = rows.assign(
        strain=curve.strain,
        rigidity=curve.modulus,
        rigidity_simulated=np.append(slope, np.nan),
        lowest_eigenvalue=curve.lowest_eigenvalue,
        event=np.append(curve.event.astype(int), 0),
    )
    return rows[at_small_strain(rows["strain"], _largest_strain(curve))]


def _largest_strain(curve: Curve) -> float:
    events = curve.strain[:-1][curve.event]
    return max(SMALL_STRAIN, RANGE_BEYOND_EVENT * events[0]) if len(events) else SMALL_STRAIN


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Rigidity g (above) and smallest eigenvalue λ_min of the Jacobian (below) of one sample "
        "against strain; left from zero to beyond the first plastic event, right every state "
        "around this event. Open symbols: linear response, joined by a line through all states; "
        "dots: slope of the simulated stress, in steps without an event; red lines: events. On "
        "the left, one state in each of 40 cells of strain has a symbol.",
        "whether dots lie in the open symbols, and whether g and λ_min announce the event or jump "
        "at it; steps of both between events are contacts that open or close.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw g above and λ_min below, over all strains and, if there is an event, around it."""
    figure.set_size_inches(7.0, 4.2)
    columns = [(table, _spread(table))]
    if table["event"].any():
        around = _around_first_event(table)
        columns.append((around, around))
    ratios = (2.0, 1.0)[: len(columns)]
    grid = figure.subplots(2, len(columns), squeeze=False, sharex="col", width_ratios=ratios)
    for (states, shown), (upper, lower) in zip(columns, grid.T, strict=True):
        _draw_rigidity(upper, states, shown)
        _draw_curve(lower, states, shown, "lowest_eigenvalue")
        lower.set(xlabel=r"$\gamma$")
    grid[0, 0].set(ylabel=labels.modulus_label("$g$", table))
    grid[1, 0].set(ylabel=labels.modulus_label(r"$\lambda_{\min}$", table))
    titles = ("rigidity", "around the first event", "smallest eigenvalue", "around the first event")
    names = [titles[2 * row + column] for row in (0, 1) for column in range(len(columns))]
    for index, (axes, name) in enumerate(zip(grid.ravel(), names, strict=True)):
        labels.name_panel(axes, index, name)
        _mark_events(axes, table)
    labels.write_sample_caption(figure, table, NOTE)


def _draw_rigidity(axes: Axes, states: pd.DataFrame, shown: pd.DataFrame) -> None:
    _draw_curve(axes, states, shown, "rigidity")
    axes.plot(shown["strain"], shown["rigidity_simulated"], "o", color="0.15", ms=1.8, mew=0)
    axes.set(ylim=_limits(states["rigidity"]))


def _draw_curve(axes: Axes, states: pd.DataFrame, shown: pd.DataFrame, column: str) -> None:
    """Draw a line through all states and open symbols at those shown, or at all if they are few."""
    known = states[states[column].notna()]
    shown = known if len(known) <= MAX_SYMBOLS else shown
    axes.plot(known["strain"], known[column], color=ROTATIONAL, lw=0.6)
    strain, values = shown["strain"], shown[column]
    axes.plot(strain, values, "o", color=ROTATIONAL, mfc="white", mew=0.7, markersize=4.2)
    low, high = states["strain"].iloc[[0, -1]]
    margin = 0.03 * (high - low)
    axes.set(xlim=(low - margin, high + margin))
    axes.locator_params(axis="x", nbins=4)


def _spread(states: pd.DataFrame) -> pd.DataFrame:
    """The first state in each of `MAX_SYMBOLS` equal cells of strain."""
    cell = np.ceil(states["strain"] / states["strain"].max() * MAX_SYMBOLS).clip(lower=1)
    return states[~cell.duplicated()]


def _around_first_event(table: pd.DataFrame) -> pd.DataFrame:
    """The states within some steps of the first event."""
    centre = table.loc[table["event"] == 1, "strain"].iloc[0]
    width = STEPS_AROUND_EVENT * table["strain"].diff().max()
    return table[(table["strain"] - centre).abs() <= width]


def _mark_events(axes: Axes, table: pd.DataFrame) -> None:
    for strain in table.loc[table["event"] == 1, "strain"]:
        axes.axvline(strain, color=RED, linewidth=0.5, zorder=1)


def _limits(rigidity: pd.Series) -> tuple[float, float]:
    """Limits around g alone, as the slope of a step in which a contact opens lies far from it."""
    margin = 0.15 * max(np.ptp(rigidity), 0.02 * abs(rigidity).max())
    return rigidity.min() - margin, rigidity.max() + margin
