"""The same state released under dampings around its growth rate (C, Fig. 11)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.release_rows import COLUMNS as RUN
from grainmodes.figures.shared.release_rows import Sample, caption, one
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a record"),
    "m": ("d^2", "mean square displacement M"),
    "pressure": ("k_N", "pressure"),
    "rate_damped": ("1/t_0", "growth rate of the pair under this damping"),
    "rate_fitted": ("1/t_0", "growth rate fitted to M; NaN: M did not grow"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of every run of a sample, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi, kt or seed asked for.
    """
    shown = one(releases, options)
    return joined((part for sample in shown for part in _runs(sample)), COLUMNS)


def _runs(sample: Sample) -> list[pd.DataFrame]:
    quantities = {"time": "time", "m": "mean_square_displacement", "pressure": "pressure"}
    return [
        sample.records(quantities, run).assign(
            rate_damped=sample.of("rate_damped")[run],
            rate_fitted=sample.of("displacement_rate")[run],
        )
        for run in range(len(sample.of("damping")))
    ]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a) M and (b) P against ω_i t, a curve per η_0; (c) the growth rates."""
    figure.set_size_inches(7.0, 2.8)
    square, pressure, rates = figure.subplots(1, 3)
    rate = table["rate"].iloc[0]
    for damping, colour, _ in appearance.series(sorted(table["damping"].unique())):
        of = table[(table["damping"] == damping) & (table["time"] > 0.0)]
        label = f"{float(f'{damping / rate:.3g}'):g}"
        square.semilogy(rate * of["time"], of["m"], color=colour, lw=0.7, label=label)
        pressure.plot(rate * of["time"], of["pressure"], color=colour, lw=0.7)
    square.legend(title=r"$\eta_0 / \omega_i$", loc="upper left")
    square.set(xscale="log", xlabel=r"$\omega_i t$", ylabel="$M / d^2$")
    label = appearance.modulus_label("$P$", table)
    pressure.set(xscale="log", xlabel=r"$\omega_i t$", ylabel=label)
    _rates(rates, table.drop_duplicates("damping"), rate)
    for place, name in enumerate(("mean square displacement", "pressure", "growth rate")):
        appearance.name_panel((square, pressure, rates)[place], place, name)
    figure.suptitle(caption(table))


def _rates(axes: Axes, runs: pd.DataFrame, rate: float) -> None:
    """Fitted rates on the line ω_i − η_0/2; runs that do not grow on the axis, as crosses."""
    line = np.linspace(0.0, 4.0, 50)
    axes.plot(line, 1.0 - 0.5 * line, color=appearance.TRANSLATIONAL, label="linear theory")
    near = runs[runs["damping"] < 4.01 * rate]
    axes.plot(near["damping"] / rate, near["rate_fitted"] / rate, "ko", mfc="none", label="fit")
    dead = near[near["rate_fitted"].isna()]
    axes.plot(dead["damping"] / rate, 0.0 * dead["damping"], "kx", label="no growth")
    axes.axhline(0.0, color="0.6", lw=0.6)
    axes.set(xlabel=r"$\eta_0 / \omega_i$", ylabel=r"growth rate / $\omega_i$", ylim=(-0.6, 1.15))
    axes.legend(loc="upper right")
