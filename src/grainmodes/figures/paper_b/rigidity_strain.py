"""Rigidity and smallest eigenvalue of one sample at small strain, through an event (B, Fig. 7).

The strains are B's, or reach beyond the first event of a sample that has it later.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.curves import Curve
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.appearance import ROTATIONAL
from grainmodes.figures.shared.rigidity_rows import UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_points import EVENTS, SAMPLE, SMALL, name_sample, sample

COLUMNS = SAMPLE | {
    "strain": ("1", "strain of a state"),
    "rigidity": (UNIT, "(g_xy + g_yx) / 2 by linear response"),
    "rigidity_simulated": (UNIT, "slope of the simulated stress in the step to the next state"),
    "lowest_eigenvalue": (UNIT, "smallest eigenvalue of the Jacobian but its translations"),
    "event": ("1", "1: a plastic event lies in the step to the next state"),
}
BEYOND = 1.25
"""Factor on the strain of the first event up to which a later one is shown."""

NOTE = (
    "open symbols: linear response, dots: slope of the stress\n"
    "in steps without plastic event; bars: events"
)


def table(ensemble, options: Options) -> pd.DataFrame:
    """g, Δσ/Δγ and λ_min of the states at small strain, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the n, phi, kt or seed asked for.
    """
    curve, rows = sample(ensemble, options, COLUMNS)
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
    return rows[rows["strain"] <= _last(curve) * (1 + 1e-9)]


def _last(curve: Curve) -> float:
    events = curve.strain[:-1][curve.event]
    return max(SMALL, BEYOND * events[0]) if len(events) else SMALL


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """g above, λ_min below, on one axis of strain."""
    figure.set_size_inches(3.5, 4.4)
    upper, lower = figure.subplots(2, 1, sharex=True)
    of = table["strain"]
    open_style = {"mfc": "none", "mew": 0.6, "markersize": 3.8}
    upper.plot(of, table["rigidity"], "o", color=ROTATIONAL, **open_style)
    upper.plot(of, table["rigidity_simulated"], "o", color="0.15", markersize=1.6, mew=0)
    lower.plot(of, table["lowest_eigenvalue"], "o", color=ROTATIONAL, **open_style)
    upper.set(ylabel=appearance.modulus_label("$g$", table), ylim=_limits(table["rigidity"]))
    label = appearance.modulus_label(r"$\lambda_{\min}$", table)
    lower.set(xlabel=r"$\gamma$", ylabel=label)
    for index, (axes, title) in enumerate(((upper, "rigidity"), (lower, "smallest eigenvalue"))):
        appearance.name_panel(axes, index, title)
        _mark_events(axes, table)
    name_sample(figure, table, NOTE)


def _mark_events(axes: Axes, table: pd.DataFrame) -> None:
    for strain in table.loc[table["event"] == 1, "strain"]:
        axes.axvline(strain, color=EVENTS, linewidth=0.5, zorder=1)


def _limits(values: pd.Series) -> tuple[float, float]:
    """Around g alone: a step in which a contact lets go has a slope far from it."""
    margin = 0.15 * max(np.ptp(values), 0.02 * abs(values).max())
    return values.min() - margin, values.max() + margin
