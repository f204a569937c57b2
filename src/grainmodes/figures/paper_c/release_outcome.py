"""What becomes of released states over all times: C, Fig. 7.

(a) mean square displacement M, C (29), (b) pressure P and (c) shear stress σ_xy against time, a
colour per state, named by its ω_i. (d) |P − P(0)| / P(0) of the state whose ω_i is nearest to that
of C's inset against ω_i t while M grows: dots with the line e^(ω_i t) through their largest value
in the linear range.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.release_rows import (
    END_TIME,
    PAPER_RATE,
    RUN,
    growing_records,
    released_states,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import MAX_CURVES, Options
from grainmodes.parameters.release import GROWTH_RANGE

QUANTITIES = {
    "time": "time",
    "m": "mean_square_displacement",
    "pressure": "pressure",
    "stress_xy": "stress_xy",
}

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a record"),
    "m": ("d^2", "mean square displacement M"),
    "pressure": (RIGIDITY_UNIT, "pressure"),
    "stress_xy": (RIGIDITY_UNIT, "stress sigma_xy"),
    **END_TIME,
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of the runs without damping, state by state, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    found = released_states(releases, options)
    places = np.linspace(0, len(found) - 1, min(len(found), MAX_CURVES))
    shown = [found[round(place)] for place in places]
    parts = (state.records(QUANTITIES).assign(end_time=state.first("end_time")) for state in shown)
    return joined(parts, COLUMNS)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Released states until long after their growth, a colour per state, named by its ω_i: "
        "(a) mean square displacement M, (b) pressure, (c) shear stress σ_xy against time. (d) |P "
        "− P(0)|/P(0) of one state while it grows, with e^(ω_i t).",
        "growth, then a plateau, then a second instability after which pressure has risen and "
        "shear stress has fallen; a small ω_i delays all of it.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the four panels."""
    figure.set_size_inches(7.0, 5.6)
    panels = figure.subplots(2, 2).ravel()
    pressure, stress = (labels.modulus_label(symbol, table) for symbol in ("$P$", r"$\sigma_{xy}$"))
    shown = (
        (panels[0], "m", "$M / d^2$", "mean square displacement"),
        (panels[1], "pressure", pressure, "pressure"),
        (panels[2], "stress_xy", stress, "shear stress"),
    )
    for rate, colour, _ in appearance.curve_styles(sorted(table["rate"].unique(), reverse=True)):
        run = table[(table["rate"] == rate) & (table["time"] > 0.0)]
        name = rf"$\omega_i = {labels.power(rate, 2)}$"
        for axes, column, _, _ in shown:
            axes.plot(run["time"], run[column], color=colour, lw=0.7, label=name)
    for index, (axes, _, label, title) in enumerate(shown):
        axes.set(xscale="log", xlabel="$t / t_0$", ylabel=label)
        labels.name_panel(axes, index, title)
    panels[0].set_yscale("log")
    entries = panels[0].get_legend_handles_labels()
    figure.legend(*entries, loc="outside lower center", ncols=4)
    panels[2].axhline(0.0, color="0.6", lw=0.6)
    nearest = (np.log(table["rate"] / PAPER_RATE)).abs().idxmin()
    _draw_growth(panels[3], table[table["rate"] == table["rate"][nearest]])
    samples = labels.count_samples([table["seed"].nunique()])
    states = labels.count_samples([table["rate"].nunique()], "state")
    figure.suptitle(", ".join([*labels.constants(table), samples, states]))


def _draw_growth(axes: Axes, records: pd.DataFrame) -> None:
    """Draw |P − P(0)| / P(0) until a little after the end of the growth, and e^(ω_i t)."""
    records = growing_records(records)
    time, start = records["rate"] * records["time"], records["pressure"].iloc[0]
    change = (records["pressure"] - start).abs() / start
    axes.semilogy(time, change, ".", color="k", ms=1.6)
    peak = change[records["m"] < GROWTH_RANGE[1]].idxmax()
    line = change[peak] * np.exp(time - time[peak])
    axes.semilogy(time, line, color=appearance.TRANSLATIONAL, label=r"$e^{\omega_i t}$")
    axes.set(
        xlabel=r"$\omega_i t$",
        ylabel="$|P - P(0)| / P(0)$",
        ylim=(change[change > 0.0].min(), 10.0 * change.max()),
    )
    name = rf"$\omega_i = {labels.power(records['rate'].iloc[0], 2)}$"
    labels.name_panel(axes, 3, f"pressure while it grows, {name}")
    axes.legend(loc="upper left")
