"""Smallest eigenvalue λ_min and rigidity g close to an event: B, Fig. 13.

(a) λ_min and (b) g against γ − γ_c, squares before and circles after the event; dots: slope of the
stress, B (17). (c) What separates both from their values at the edge γ_c− of the event, with a
straight line and the square root of a fold.

Where a balance ends in a fold, λ_min vanishes as (γ_c − γ)^(1/2) and g diverges as its inverse.
Without a fold both reach the event in a straight line, and the distance to their values at its edge
falls in proportion to γ_c − γ.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import AFTER, BEFORE
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.event_rows import SAMPLE, rows_from_variables, sample_with
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

PAPER_N = 128
LINEAR_RANGE = 1e-10
"""|γ − γ_c| up to which its axis is linear; beyond, it is logarithmic."""

COLUMNS = {
    **SAMPLE,
    "distance": ("1", "strain from the event to the state, right to the width of its bracket"),
    "strain": ("1", "strain of the state"),
    "lowest_eigenvalue": (
        RIGIDITY_UNIT,
        "smallest eigenvalue of the Jacobian but the translations",
    ),
    "g": (RIGIDITY_UNIT, "rigidity by linear response"),
    "g_numerical": (RIGIDITY_UNIT, "rigidity as slope of the stress, away from the event"),
    "eigenvalue_change": (
        RIGIDITY_UNIT,
        "distance of the eigenvalue to that at the edge of the event",
    ),
    "g_change": (RIGIDITY_UNIT, "distance of g to that at the edge of the event"),
    "changes": ("1", "contacts that differ from those at the edge of the event"),
}

VARIABLES = {
    "distance": "near_distance",
    "strain": "near_strain",
    "lowest_eigenvalue": "near_lowest_eigenvalue",
    "g": "near_g",
    "g_numerical": "near_g_numerical",
    "changes": "near_changes",
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """A row per state, strain ascending, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    shown = sample_with("event_count", event_details, options, PAPER_N)
    parts = (_with_changes(rows_from_variables(block, VARIABLES)) for block in shown)
    return joined(parts, COLUMNS)


def _with_changes(states: pd.DataFrame) -> pd.DataFrame:
    """Add the distances to the values of the closest state on the same side of the event."""
    edge = states.groupby(states["distance"] > 0)["distance"].transform(lambda d: d.abs().idxmin())
    for column, name in (("eigenvalue_change", "lowest_eigenvalue"), ("g_change", "g")):
        states[column] = np.abs(states[name] - states[name].loc[edge].to_numpy())
    return states


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "States around one plastic event at γ_c, squares before and circles after it: (a) "
        "smallest eigenvalue λ_min of the Jacobian and (b) rigidity g, whose dots are the slope "
        "of the stress, against γ − γ_c; the axis is linear within 10⁻¹⁰ and logarithmic beyond. "
        "(c) Their distance to the values at the edge γ_c− of the event, with a straight line "
        "(grey) and the square root of a fold (dashed).",
        "the jump at γ_c, and whether the symbols in (c) follow the straight line rather than the "
        "dashed one: then the event comes without a precursor.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the three panels."""
    figure.set_size_inches(7.0, 2.9)
    eigenvalue, rigidity, approach = figure.subplots(1, 3)
    before, after = table[table["distance"] < 0], table[table["distance"] > 0]
    for states, colour, marker, name in (
        (before, BEFORE, "s", "before"),
        (after, AFTER, "o", "after"),
    ):
        style = {"color": colour, "mfc": "none", "markersize": 5.5, "label": name}
        eigenvalue.plot(states["distance"], states["lowest_eigenvalue"], marker + "-", **style)
        rigidity.plot(states["distance"], states["g"], marker + "-", **style)
        rigidity.plot(states["distance"], states["g_numerical"], ".", color="k", markersize=3.5)
    rigidity.plot([], [], ".", color="k", markersize=3.5, label=r"slope of $\sigma$")
    _finish_panel(eigenvalue, 0, r"$\lambda_{\min}$", "lowest eigenvalue", table)
    _finish_panel(rigidity, 1, "$g$", "rigidity", table)
    _draw_approach(approach, before)
    critical = after["strain"].min()
    figure.suptitle(labels.sample_caption(table, rf"$\gamma_c = {critical:.10f}$"))


def _finish_panel(axes: Axes, index: int, symbol: str, name: str, table: pd.DataFrame) -> None:
    axes.set_xscale("symlog", linthresh=LINEAR_RANGE, linscale=0.5)
    axes.set_xticks([-1e-4, -1e-7, 0, 1e-7, 1e-4])
    axes.minorticks_off()
    axes.axvline(0.0, color="0.7", lw=0.6, zorder=0)
    axes.set(xlabel=r"$\gamma - \gamma_c$", ylabel=labels.modulus_label(symbol, table))
    labels.name_panel(axes, index, name)
    axes.margins(y=0.25)
    axes.legend(loc="best")


def _draw_approach(axes: Axes, before: pd.DataFrame) -> None:
    """Draw the distances to the values at γ_c−, and the slopes of a straight line and of a fold."""
    size = -before["distance"]
    quantities = (("eigenvalue_change", "s", r"$\lambda_{\min}$"), ("g_change", "^", "$g$"))
    for column, marker, name in quantities:
        change = before[column].where(before[column] > 0.0)
        axes.loglog(size, change, marker, color=BEFORE, mfc="none", label=name)
    farthest = before.loc[before["distance"].idxmin()]
    for column, _, _ in quantities:
        straight = farthest[column] * size / size.max()
        axes.loglog(size, straight, "-", color="0.6", lw=0.7, zorder=0)
    fold = farthest["lowest_eigenvalue"] * np.sqrt(size / size.max())
    axes.loglog(size, fold, "--", color="k", lw=0.8, label=r"fold: $(\gamma_c - \gamma)^{1/2}$")
    unit = labels.modulus_label("distance", before)
    axes.set(xlabel=r"$\gamma_c - \gamma$", ylabel=unit)
    labels.name_panel(axes, 2, r"distance to the values at $\gamma_{c-}$")
    axes.legend(loc="best")
