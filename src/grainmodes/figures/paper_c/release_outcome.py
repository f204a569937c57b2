"""What becomes of released states: M, pressure and shear stress over all times (C, Fig. 7)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.release_rows import COLUMNS as RUN
from grainmodes.figures.shared.release_rows import growing, samples
from grainmodes.figures.shared.selection import MOST_CURVES, Options
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
    "pressure": ("k_N", "pressure"),
    "stress_xy": ("k_N", "stress sigma_xy"),
    "end_time": ("t_0", "when M leaves its law"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of the runs without damping, sample by sample, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi or kt asked for.
    """
    shown = samples(releases, options)[:MOST_CURVES]
    return joined(
        (sample.records(QUANTITIES).assign(end_time=sample.of("end_time")[0]) for sample in shown),
        COLUMNS,
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a) M, (b) P, (c) σ_xy, a curve per sample; (d) P − P(0) of the first while it grows."""
    figure.set_size_inches(7.0, 5.2)
    panels = figure.subplots(2, 2).ravel()
    rates = sorted(table["rate"].unique(), reverse=True)
    for rate, colour, _ in appearance.series(rates):
        of = table[(table["rate"] == rate) & (table["time"] > 0.0)]
        label = rf"$\omega_i = {appearance.power(float(f'{rate:.2g}'))}$"
        for axes, column in zip(panels, ("m", "pressure", "stress_xy"), strict=False):
            axes.plot(of["time"], of[column], color=colour, lw=0.7, label=label)
    labels = (
        "$M / d^2$",
        appearance.modulus_label("$P$", table),
        appearance.modulus_label(r"$\sigma_{xy}$", table),
    )
    titles = ("mean square displacement", "pressure", "shear stress")
    for place, (axes, label, title) in enumerate(zip(panels, labels, titles, strict=False)):
        axes.set(xscale="log", xlabel="$t / t_0$", ylabel=label)
        appearance.name_panel(axes, place, title)
    panels[0].set_yscale("log")
    panels[0].legend(loc="upper left")
    panels[2].axhline(0.0, color="0.6", lw=0.6)
    first = table[table["seed"] == table["seed"].iloc[0]]
    _growing(panels[3], first)
    constants = [appearance.CONSTANTS[name](table[name].iloc[0]) for name in ("n", "phi", "kt")]
    figure.suptitle(", ".join([*constants, appearance.samples([table["seed"].nunique()])]))


def _growing(axes: Axes, of: pd.DataFrame) -> None:
    """|P − P(0)| against ω_i t until a little after the growth, and e^(ω_i t) on its peaks."""
    of = growing(of)
    time, start = of["rate"] * of["time"], of["pressure"].iloc[0]
    change = (of["pressure"] - start).abs() / start
    axes.semilogy(time, change, ".", color="k", ms=1.6)
    peak = change[of["m"] < GROWTH_RANGE[1]].idxmax()
    line = change[peak] * np.exp(time - time[peak])
    axes.semilogy(time, line, color=appearance.TRANSLATIONAL, label=r"$e^{\omega_i t}$")
    axes.set(
        xlabel=r"$\omega_i t$",
        ylabel="$|P - P(0)| / P(0)$",
        ylim=(change[change > 0.0].min(), 10.0 * change.max()),
    )
    appearance.name_panel(axes, 3, f"pressure while it grows, seed {of['seed'].iloc[0]}")
    axes.legend(loc="upper left")
