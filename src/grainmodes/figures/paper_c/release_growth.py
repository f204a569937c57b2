"""Growth of M(t) and A(t), C (29), (30), while a released pair grows: C, Fig. 6.

(a), (b): M and A turn by turn, circles from the dynamics, line the fit. (c), (d): the whole growth
against ω_i t on a logarithmic axis, dots from the dynamics, line e^(2 ω_i t) of the pair, C (13).
The caption states what the fitted rates differ from those of the pair by.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import TRANSLATIONAL
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.release_rows import (
    END_TIME,
    RUN,
    ReleasedSample,
    growing_records,
    one_released_sample,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.release import DENSE_RECORDS_ONSET
from grainmodes.protocols.release.growth_fit import in_growth_range

SHOWN_TURNS = 6.0
"""Number of turns 2π/ω_r in the upper panels, as far as M is within the range of the fit."""

QUANTITIES = {"m": ("displacement", "$M$", "$d^2$"), "a": ("rotation", "$A$", r"$\mathrm{rad}^2$")}
"""Column → the name of its fit, its symbol and its unit."""

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a record"),
    "m": ("d^2", "mean square displacement M"),
    "a": ("rad^2", "mean square rotation A"),
    "m_fit": ("d^2", "the fit to M"),
    "a_fit": ("rad^2", "the fit to A"),
    "turns_from": ("t_0", "time at which the panels of single turns begin"),
    "growth_error": ("1", "fitted omega_i of M over that of the pair, minus 1"),
    "frequency_error": ("1", "fitted omega_r of M over that of the pair, minus 1"),
    **END_TIME,
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of the run without damping, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    return joined((_rows(sample) for sample in one_released_sample(releases, options)), COLUMNS)


def _rows(sample: ReleasedSample) -> pd.DataFrame:
    names = {"time": "time", "m": "mean_square_displacement", "a": "mean_square_rotation"}
    rows = sample.records(names)
    for column, (name, _, _) in QUANTITIES.items():
        rows[f"{column}_fit"] = _fit(sample, name, rows["time"].to_numpy())
    for column, name in (("growth", "rate"), ("frequency", "frequency")):
        fitted = sample.first(f"displacement_{name}")
        rows[f"{column}_error"] = fitted / sample.values(f"{name}_linear") - 1.0
    rows["turns_from"] = rows["time"].where(rows["m"] > DENSE_RECORDS_ONSET).min()
    return rows.assign(end_time=sample.first("end_time"))


def _fit(sample: ReleasedSample, name: str, time: np.ndarray) -> np.ndarray:
    """The fitted oscillation that grows, at these times."""
    rate, frequency, size, depth, phase = (
        sample.first(f"{name}_{part}") for part in ("rate", "frequency", "size", "depth", "phase")
    )
    swing = 1.0 + depth * np.cos(2.0 * frequency * time - phase)
    with np.errstate(over="ignore"):
        return size * np.exp(2.0 * rate * time) * swing


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Mean square displacement M(t) and mean square rotation A(t), C (29), (30), while a "
        "released complex pair grows: (a), (b) turn by turn, circles from the dynamics, line the "
        "fitted oscillation that grows; (c), (d) the whole growth, dots from the dynamics, line "
        "e^(2 ω_i t) of the pair. The numbers above say how far the fitted ω_i and ω_r are from "
        "those of the pair.",
        "whether the motion has the frequency and the growth rate of the pair, and at which M the "
        "growth ends.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the panels, M on the left and A on the right."""
    figure.set_size_inches(7.0, 5.0)
    panels = figure.subplots(2, 2)
    for place, (column, (_, symbol, unit)) in enumerate(QUANTITIES.items()):
        decade = _draw_turns(panels[0, place], table, column)
        _draw_growth(panels[1, place], table, column)
        panels[0, place].set_ylabel(rf"{symbol} / ${labels.power(decade)}$ {unit}")
        panels[1, place].set_ylabel(f"{symbol} / {unit}")
        labels.name_panel(panels[0, place], place, f"{symbol}, turn by turn")
        labels.name_panel(panels[1, place], 2 + place, f"{symbol}, growth")
    errors = rf"fit of $M$: $\omega_i$ {_percent(table, 'growth_error')}, "
    errors += rf"$\omega_r$ {_percent(table, 'frequency_error')} off the pair"
    figure.suptitle(f"{release_caption(table)}\n{errors}")


def _percent(table: pd.DataFrame, column: str) -> str:
    return f"{100.0 * table[column].iloc[0]:.2g} %"


def _draw_turns(axes: Axes, table: pd.DataFrame, column: str) -> float:
    """Draw some turns, in units of a power of ten; returns this unit."""
    turn = 2.0 * np.pi / table["frequency"].iloc[0]
    start = table["turns_from"].iloc[0]
    shown = table[in_growth_range(table["m"].to_numpy())]
    shown = shown[shown["time"].between(start, start + SHOWN_TURNS * turn)]
    time = shown["time"] - start
    decade = 10.0 ** np.floor(np.log10(shown[column].max()))
    axes.plot(time, shown[column] / decade, "o", color="k", ms=2.5, mfc="none", label="dynamics")
    axes.plot(time, shown[f"{column}_fit"] / decade, color=TRANSLATIONAL, label="law")
    axes.set(xlabel=rf"$(t - {start:.0f}\,t_0) / t_0$", ylim=(0.0, None))
    axes.legend(loc="upper left")
    return float(decade)


def _draw_growth(axes: Axes, table: pd.DataFrame, column: str) -> None:
    """Draw the growth, and e^(2 ω_i t) of the pair through the largest value of the fit."""
    shown = growing_records(table)
    time = shown["rate"] * shown["time"]
    axes.semilogy(time, shown[column], ".", color="k", ms=1.6, label="dynamics")
    largest = shown[column].max()
    fit = shown[f"{column}_fit"].where(shown[f"{column}_fit"] < 10.0 * largest)
    envelope = fit.max() * np.exp(2.0 * (time - time[fit.idxmax()]))
    inside = (envelope > shown[column][shown[column] > 0.0].min()) & (envelope < 10.0 * largest)
    style = {"color": TRANSLATIONAL, "label": r"$e^{2 \omega_i t}$ of the pair"}
    axes.semilogy(time[inside], envelope[inside], **style)
    axes.set_xlabel(r"$\omega_i t$")
    axes.legend(loc="upper left")
