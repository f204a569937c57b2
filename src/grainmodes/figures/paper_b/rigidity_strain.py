"""Rigidity and smallest eigenvalue of one sample at small strain, through an event: B, Fig. 7.

Above g: open symbols by linear response, dots as slope of the stress in steps without a plastic
event. Below λ_min of the Jacobian. Vertical lines mark events. The strains are B's, or reach beyond
the first event of a sample that has it later.
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
    "open symbols: linear response, dots: slope of the stress\n"
    "in steps without plastic event; bars: events"
)


def table(ensemble, options: Options) -> pd.DataFrame:
    """g, Δσ/Δγ and λ_min of the states at small strain, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the requested n, phi, kt or seed.
    """
    curve, rows = one_curve(ensemble, options, COLUMNS)
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
        "Rigidity g (a) and smallest eigenvalue λ_min of the Jacobian (b) of one sample against "
        "strain, from zero to beyond its first plastic event. Open symbols: linear response; "
        "dots: slope of the simulated stress, in steps without an event; red lines: events.",
        "whether dots lie in the open symbols, and whether g and λ_min announce an event or jump "
        "at it.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw g above and λ_min below, on one axis of strain."""
    figure.set_size_inches(3.5, 4.4)
    upper, lower = figure.subplots(2, 1, sharex=True)
    strain = table["strain"]
    open_style = {"color": ROTATIONAL, "mfc": "none", "mew": 0.6, "markersize": 3.8}
    upper.plot(strain, table["rigidity"], "o", **open_style)
    upper.plot(strain, table["rigidity_simulated"], "o", color="0.15", markersize=1.6, mew=0)
    lower.plot(strain, table["lowest_eigenvalue"], "o", **open_style)
    upper.set(ylabel=labels.modulus_label("$g$", table), ylim=_limits(table["rigidity"]))
    label = labels.modulus_label(r"$\lambda_{\min}$", table)
    lower.set(xlabel=r"$\gamma$", ylabel=label)
    for index, (axes, title) in enumerate(((upper, "rigidity"), (lower, "smallest eigenvalue"))):
        labels.name_panel(axes, index, title)
        _mark_events(axes, table)
    labels.write_sample_caption(figure, table, NOTE)


def _mark_events(axes: Axes, table: pd.DataFrame) -> None:
    for strain in table.loc[table["event"] == 1, "strain"]:
        axes.axvline(strain, color=RED, linewidth=0.5, zorder=1)


def _limits(rigidity: pd.Series) -> tuple[float, float]:
    """Limits around g alone, as the slope of a step in which a contact opens lies far from it."""
    margin = 0.15 * max(np.ptp(rigidity), 0.02 * abs(rigidity).max())
    return rigidity.min() - margin, rigidity.max() + margin
