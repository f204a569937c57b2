"""M(t) and A(t) while a released pair grows, against linear theory (C, Fig. 6)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.release_rows import COLUMNS as RUN
from grainmodes.figures.shared.release_rows import Sample, caption, growing, one
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.release import DENSE_RECORDS_ONSET
from grainmodes.protocols.release.growth_fit import in_growth_range

CLOSE_TURNS = 6.0
"""Turns of 2π/ω_r that the upper panels show, if M is within the range of the fit so long."""

QUANTITIES = {"m": ("displacement", "$M$", "$d^2$"), "a": ("rotation", "$A$", r"$\mathrm{rad}^2$")}
"""Column → the name of its law, its symbol and its unit."""

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a record"),
    "m": ("d^2", "mean square displacement M"),
    "a": ("rad^2", "mean square rotation A"),
    "m_law": ("d^2", "the law fitted to M"),
    "a_law": ("rad^2", "the law fitted to A"),
    "close_from": ("t_0", "where the close looks begin"),
    "growth_error": ("1", "fitted omega_i of M over that of the pair, minus 1"),
    "frequency_error": ("1", "fitted omega_r of M over that of the pair, minus 1"),
    "end_time": ("t_0", "when M leaves its law"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of the run without damping, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi, kt or seed asked for.
    """
    return joined((_rows(sample) for sample in one(releases, options)), COLUMNS)


def _rows(sample: Sample) -> pd.DataFrame:
    names = {"time": "time", "m": "mean_square_displacement", "a": "mean_square_rotation"}
    rows = sample.records(names)
    for column, (name, _, _) in QUANTITIES.items():
        rows[f"{column}_law"] = _law(sample, name, rows["time"].to_numpy())
    for column, name in (("growth", "rate"), ("frequency", "frequency")):
        fitted = sample.of(f"displacement_{name}")[0]
        rows[f"{column}_error"] = fitted / sample.of(f"{name}_linear") - 1.0
    rows["close_from"] = rows["time"].where(rows["m"] > DENSE_RECORDS_ONSET).min()
    return rows.assign(end_time=sample.of("end_time")[0])


def _law(sample: Sample, name: str, time: np.ndarray) -> np.ndarray:
    rate, frequency, size, depth, phase = (
        sample.of(f"{name}_{part}")[0] for part in ("rate", "frequency", "size", "depth", "phase")
    )
    swing = 1.0 + depth * np.cos(2.0 * frequency * time - phase)
    with np.errstate(over="ignore"):
        return size * np.exp(2.0 * rate * time) * swing


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a), (b): some turns closely; (c), (d): the whole growth with its law."""
    figure.set_size_inches(7.0, 5.0)
    panels = figure.subplots(2, 2)
    for place, (column, (_, symbol, unit)) in enumerate(QUANTITIES.items()):
        decade = _close(panels[0, place], table, column)
        _whole(panels[1, place], table, column)
        panels[0, place].set_ylabel(rf"{symbol} / ${appearance.power(decade)}$ {unit}")
        panels[1, place].set_ylabel(f"{symbol} / {unit}")
        for row in (0, 1):
            kind = ("turn by turn", "growth")[row]
            appearance.name_panel(panels[row, place], 2 * row + place, f"{symbol}, {kind}")
    errors = rf"fit of $M$: $\omega_i$ {_percent(table, 'growth_error')}, "
    errors += rf"$\omega_r$ {_percent(table, 'frequency_error')} off the pair"
    figure.suptitle(f"{caption(table)}\n{errors}")


def _percent(table: pd.DataFrame, column: str) -> str:
    return f"{100.0 * table[column].iloc[0]:.2g} %"


def _close(axes: Axes, table: pd.DataFrame, column: str) -> float:
    """Some turns, in units of a power of ten; returns it."""
    turn = 2.0 * np.pi / table["frequency"].iloc[0]
    start = table["close_from"].iloc[0]
    near = table[in_growth_range(table["m"].to_numpy())]
    near = near[near["time"].between(start, start + CLOSE_TURNS * turn)]
    x = near["time"] - start
    decade = 10.0 ** np.floor(np.log10(near[column].max()))
    axes.plot(x, near[column] / decade, "o", color="k", ms=2.5, mfc="none", label="dynamics")
    axes.plot(x, near[f"{column}_law"] / decade, color=appearance.TRANSLATIONAL, label="law")
    axes.set(xlabel=rf"$(t - {start:.0f}\,t_0) / t_0$", ylim=(0.0, None))
    axes.legend(loc="upper left")
    return float(decade)


def _whole(axes: Axes, table: pd.DataFrame, column: str) -> None:
    shown = growing(table)
    time = shown["rate"] * shown["time"]
    axes.semilogy(time, shown[column], ".", color="k", ms=1.6, label="dynamics")
    edge = shown[column].max()
    law = shown[f"{column}_law"].where(shown[f"{column}_law"] < 10.0 * edge)
    envelope = law.max() * np.exp(2.0 * (time - time[law.idxmax()]))
    inside = (envelope > shown[column][shown[column] > 0.0].min()) & (envelope < 10.0 * edge)
    axes.semilogy(
        time[inside],
        envelope[inside],
        color=appearance.TRANSLATIONAL,
        label=r"$e^{2 \omega_i t}$ of the pair",
    )
    axes.set_xlabel(r"$\omega_i t$")
    axes.legend(loc="upper left")
