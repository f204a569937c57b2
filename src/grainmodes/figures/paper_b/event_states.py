"""Lowest eigenvalue and rigidity around an event: is there a precursor? (B, Figs. 3 and 13.)

Where a balance ends in a fold, λ vanishes as (γ_c − γ)^(1/2) and g diverges as its inverse. Without
one both reach the event in a straight line, and their distance to what they are at its edge falls
in proportion to γ_c − γ.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.event_detail_rows import (
    AFTER,
    BEFORE,
    SAMPLE,
    caption,
    rows,
    with_event,
)
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.selection import Options

PAPER_N = 128
CLOSEST = 1e-10

COLUMNS = {
    **SAMPLE,
    "distance": ("1", "strain from the event to the state, right to the width of its bracket"),
    "strain": ("1", "strain of the state"),
    "lowest_eigenvalue": ("k_N", "smallest eigenvalue of the Jacobian but the translations"),
    "g": ("k_N", "rigidity by linear response"),
    "g_numerical": ("k_N", "rigidity as slope of the stress, away from the event"),
    "eigenvalue_change": ("k_N", "distance of the eigenvalue to that at the edge of the event"),
    "g_change": ("k_N", "distance of g to that at the edge of the event"),
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
        ValueError: no sample has the n, phi or kt asked for.
    """
    shown = with_event(event_details, options, PAPER_N)
    return joined((_with_changes(rows(block, VARIABLES)) for block in shown), COLUMNS)


def _with_changes(states: pd.DataFrame) -> pd.DataFrame:
    edge = states.groupby(states["distance"] > 0)["distance"].transform(lambda d: d.abs().idxmin())
    for column, name in (("eigenvalue_change", "lowest_eigenvalue"), ("g_change", "g")):
        states[column] = np.abs(states[name] - states[name].loc[edge].to_numpy())
    return states


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a), (b): both against γ − γ_c; (c): how they come to their values at its edge."""
    figure.set_size_inches(7.0, 2.9)
    eigenvalue, rigidity, approach = figure.subplots(1, 3)
    sides = (table[table["distance"] < 0], table[table["distance"] > 0])
    for of, colour, marker, name in zip(
        sides, (BEFORE, AFTER), "so", ("before", "after"), strict=True
    ):
        style = {"color": colour, "mfc": "none", "markersize": 5.5, "label": name}
        eigenvalue.plot(of["distance"], of["lowest_eigenvalue"], marker + "-", **style)
        rigidity.plot(of["distance"], of["g"], marker + "-", **style)
        rigidity.plot(of["distance"], of["g_numerical"], ".", color="k", markersize=3.5)
    rigidity.plot([], [], ".", color="k", markersize=3.5, label=r"slope of $\sigma$")
    panels = (
        (eigenvalue, r"$\lambda_{\min}$", "lowest eigenvalue"),
        (rigidity, "$g$", "rigidity"),
    )
    for index, (axes, symbol, name) in enumerate(panels):
        axes.set_xscale("symlog", linthresh=CLOSEST, linscale=0.5)
        axes.set_xticks([-1e-4, -1e-7, 0, 1e-7, 1e-4])
        axes.minorticks_off()
        axes.axvline(0.0, color="0.7", lw=0.6, zorder=0)
        axes.set(xlabel=r"$\gamma - \gamma_c$", ylabel=appearance.modulus_label(symbol, table))
        appearance.name_panel(axes, index, name)
        axes.margins(y=0.25)
        axes.legend(loc="best")
    _approach(approach, sides[0])
    figure.suptitle(caption(table, rf"$\gamma_c = {_critical(table):.10f}$"))


def _critical(table: pd.DataFrame) -> float:
    """The strain of the state just after the event, γ_c+."""
    return table.loc[table["distance"] > 0, "strain"].min()


def _approach(axes: Axes, before: pd.DataFrame) -> None:
    """What is left to the values at γ_c−, and the slopes of a straight line and of a fold."""
    size, styles = -before["distance"], (("eigenvalue_change", "s", r"$\lambda_{\min}$"),)
    for column, marker, name in (*styles, ("g_change", "^", "$g$")):
        left = before[column].where(before[column] > 0.0)
        axes.loglog(size, left, marker, color=BEFORE, mfc="none", label=name)
    largest = before.loc[before["distance"].idxmin()]
    for column in ("eigenvalue_change", "g_change"):
        line = largest[column] * size / size.max()
        axes.loglog(size, line, "-", color="0.6", lw=0.7, zorder=0)
    fold = largest["lowest_eigenvalue"] * np.sqrt(size / size.max())
    axes.loglog(size, fold, "--", color="k", lw=0.8, label=r"fold: $(\gamma_c - \gamma)^{1/2}$")
    unit = appearance.modulus_label("distance", before)
    axes.set(xlabel=r"$\gamma_c - \gamma$", ylabel=unit)
    appearance.name_panel(axes, 2, r"distance to the values at $\gamma_{c-}$")
    axes.legend(loc="best")
