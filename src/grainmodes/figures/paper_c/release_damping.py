"""The same unstable state released under dampings η_0 around its growth rate: C, Fig. 11.

(a) mean square displacement M, C (29), and (b) |P − P(0)| / P(0) against ω_i t, a colour per η_0:
on the scale of P itself all curves lie on each other until the end. (c) growth rates fitted to M
(circles; crosses where M does not grow) and linear theory, line: the quadratic eigenproblem with
the drag of the runs, dashed: ω_i − η_0/2, a drag on all motion.
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
    RUN,
    ReleasedState,
    one_released_state,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a record"),
    "m": ("d^2", "mean square displacement M"),
    "pressure": (RIGIDITY_UNIT, "pressure"),
    "rate_damped": ("1/t_0", "growth rate of the pair under this damping"),
    "rate_fitted": ("1/t_0", "growth rate fitted to M; NaN: M did not grow"),
    "kind": ("", "record: a time of a run; theory: a damping on the curve of linear theory"),
    "damped_motion": ("", "what is damped: translations, or all motion"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of every run of a state, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    shown = one_released_state(releases, options)
    rows = (rows for state in shown for rows in (*_rows_of_runs(state), _theory(state)))
    return joined(rows, COLUMNS)


def _rows_of_runs(state: ReleasedState) -> list[pd.DataFrame]:
    quantities = {"time": "time", "m": "mean_square_displacement", "pressure": "pressure"}
    return [
        state.records(quantities, run).assign(
            kind="record",
            damped_motion=state.damped_motion,
            rate_damped=state.values("rate_damped")[run],
            rate_fitted=state.values("displacement_rate")[run],
        )
        for run in range(len(state.values("damping")))
    ]


def _theory(state: ReleasedState) -> pd.DataFrame:
    """The curve of linear theory, a row per damping."""
    curve = {
        "damping": state.values("theory_damping"),
        "rate_damped": state.values("theory_rate"),
        "kind": "theory",
        "damped_motion": state.damped_motion,
        **dict.fromkeys(("time", "m", "pressure", "rate_fitted"), np.nan),
    }
    return pd.DataFrame(state.identity() | curve)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    damped = "translations alone" if _on_translations(table) else "all motion"
    return Caption(
        f"The same unstable state released under background drags η_0 on {damped}, a colour per "
        "η_0/ω_i: (a) mean square displacement M, (b) |P − P(0)|/P(0), against ω_i t; (c) growth "
        "rate fitted to M (circles; crosses: M does not grow) over ω_i, line: linear theory, the "
        "quadratic eigenproblem with this drag; dashed: linear theory of a drag on all motion.",
        "a drag well below ω_i changes little; the growth ends where the line crosses 0, and "
        "nothing grows beyond.",
    )


def _on_translations(table: pd.DataFrame) -> bool:
    return bool(table["damped_motion"].iloc[0] == "translations")


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the three panels."""
    figure.set_size_inches(7.0, 3.1)
    square, pressure, rates = figure.subplots(1, 3)
    rate, runs = table["rate"].iloc[0], table[table["kind"] == "record"]
    for damping, colour, _ in appearance.curve_styles(sorted(runs["damping"].unique())):
        run = runs[runs["damping"] == damping]
        change = (run["pressure"] / run["pressure"].iloc[0] - 1.0).abs()
        shown = run["time"] > 0.0
        label = f"{float(f'{damping / rate:.3g}'):g}"
        time, style = rate * run["time"][shown], {"color": colour, "lw": 0.7}
        square.plot(time, run["m"][shown], label=label, **style)
        pressure.plot(time, change.where(change > 0.0)[shown], **style)
    square.set(ylabel="$M / d^2$")
    pressure.set(ylabel="$|P - P(0)| / P(0)$")
    for axes in (square, pressure):
        axes.set(xscale="log", yscale="log", xlabel=r"$\omega_i t$")
    _draw_rates(rates, table, rate)
    for index, axes in enumerate((square, pressure, rates)):
        labels.name_panel(
            axes, index, ("mean square displacement", "pressure", "growth rate")[index]
        )
    entries = square.get_legend_handles_labels()
    figure.legend(
        *entries, title=r"(a), (b): $\eta_0 / \omega_i$", loc="outside lower left", ncols=6
    )
    figure.suptitle(release_caption(table))


def _draw_rates(axes: Axes, table: pd.DataFrame, rate: float) -> None:
    """Draw the fitted rates on the curve of linear theory; runs without growth on the axis."""
    theory = table[table["kind"] == "theory"]
    runs = table[table["kind"] == "record"].drop_duplicates("damping")
    damping, last = theory["damping"] / rate, theory["damping"].max() / rate
    axes.plot(
        damping, theory["rate_damped"] / rate, color=appearance.TRANSLATIONAL, label="linear theory"
    )
    if _on_translations(table):
        axes.plot(
            damping, 1.0 - 0.5 * damping, "--", color="0.5", lw=0.8, label="all motion damped"
        )
    shown = runs[runs["damping"] <= 1.001 * last * rate]
    axes.plot(shown["damping"] / rate, shown["rate_fitted"] / rate, "ko", mfc="none", label="fit")
    decaying = shown[shown["rate_fitted"].isna()]
    axes.plot(decaying["damping"] / rate, 0.0 * decaying["damping"], "kx", label="no growth")
    axes.axhline(0.0, color="0.6", lw=0.6)
    axes.set(xlabel=r"$\eta_0 / \omega_i$", ylabel=r"growth rate / $\omega_i$", ylim=(-0.6, 1.6))
    axes.legend(loc="upper right")
