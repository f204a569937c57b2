"""The same unstable state released under dampings η_0 around its growth rate: C, Fig. 11.

(a) mean square displacement M, C (29), and (b) pressure against ω_i t, a colour per η_0. (c) growth
rates fitted to M (circles; crosses where M does not grow) and linear theory, ω_i − η_0/2.
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
    ReleasedSample,
    one_released_sample,
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
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of every run of a sample, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    shown = one_released_sample(releases, options)
    return joined((rows for sample in shown for rows in _rows_of_runs(sample)), COLUMNS)


def _rows_of_runs(sample: ReleasedSample) -> list[pd.DataFrame]:
    quantities = {"time": "time", "m": "mean_square_displacement", "pressure": "pressure"}
    return [
        sample.records(quantities, run).assign(
            rate_damped=sample.values("rate_damped")[run],
            rate_fitted=sample.values("displacement_rate")[run],
        )
        for run in range(len(sample.values("damping")))
    ]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "One unstable state released under several dampings η_0: (a) mean square displacement M "
        "and (b) pressure against ω_i t, a colour per η_0; (c) growth rate against η_0, both over "
        "ω_i: circles, fit to M; crosses, no growth; line, linear theory.",
        "a damping well below ω_i changes little; one well above it suppresses the instability.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the three panels."""
    figure.set_size_inches(7.0, 2.8)
    square, pressure, rates = figure.subplots(1, 3)
    rate = table["rate"].iloc[0]
    for damping, colour, _ in appearance.curve_styles(sorted(table["damping"].unique())):
        run = table[(table["damping"] == damping) & (table["time"] > 0.0)]
        label = f"{float(f'{damping / rate:.3g}'):g}"
        square.semilogy(rate * run["time"], run["m"], color=colour, lw=0.7, label=label)
        pressure.plot(rate * run["time"], run["pressure"], color=colour, lw=0.7)
    square.legend(title=r"$\eta_0 / \omega_i$", loc="upper left")
    square.set(xscale="log", xlabel=r"$\omega_i t$", ylabel="$M / d^2$")
    label = labels.modulus_label("$P$", table)
    pressure.set(xscale="log", xlabel=r"$\omega_i t$", ylabel=label)
    _draw_rates(rates, table.drop_duplicates("damping"), rate)
    labels.name_panel(square, 0, "mean square displacement")
    labels.name_panel(pressure, 1, "pressure")
    labels.name_panel(rates, 2, "growth rate")
    figure.suptitle(release_caption(table))


def _draw_rates(axes: Axes, runs: pd.DataFrame, rate: float) -> None:
    """Draw the fitted rates on the line of linear theory; runs without growth on the axis."""
    line = np.linspace(0.0, 4.0, 50)
    axes.plot(line, 1.0 - 0.5 * line, color=appearance.TRANSLATIONAL, label="linear theory")
    shown = runs[runs["damping"] < 4.01 * rate]
    axes.plot(shown["damping"] / rate, shown["rate_fitted"] / rate, "ko", mfc="none", label="fit")
    decaying = shown[shown["rate_fitted"].isna()]
    axes.plot(decaying["damping"] / rate, 0.0 * decaying["damping"], "kx", label="no growth")
    axes.axhline(0.0, color="0.6", lw=0.6)
    axes.set(xlabel=r"$\eta_0 / \omega_i$", ylabel=r"growth rate / $\omega_i$", ylim=(-0.6, 1.15))
    axes.legend(loc="upper right")
