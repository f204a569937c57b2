"""Growth of M(t) and A(t), C (29), (30), while a released pair grows: C, Fig. 6.

(a), (b): M and A in the first turns, circles from the dynamics, line a e^(2 ω_i t) sin²(ω_r t) of
C (13) with ω_i and ω_r of the pair; only a is fitted. (c), (d): the whole growth against ω_i t on a
logarithmic axis, dots from the dynamics, line e^(2 ω_i t) of the pair. (e), (f): late turns,
circles from the dynamics, line the fit. The caption states by what the fitted rates differ from
those of the pair.
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
    ReleasedState,
    growing_records,
    growth_line,
    one_released_state,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options
from grainmodes.parameters.release import DENSE_RECORDS_ONSET
from grainmodes.protocols.release.growth_fit import in_growth_range

SHOWN_TURNS = 6.0
"""Number of turns 2π/ω_r in the panels of single turns; late ones as far as M is in the range of
the fit."""

QUANTITIES = {"m": ("displacement", "$M$", "$d^2$"), "a": ("rotation", "$A$", r"$\mathrm{rad}^2$")}
"""Column → the name of its fit, its symbol and its unit."""

LAW_WORDS = {"early": r"$e^{2 \omega_i t} \sin^2 \omega_r t$", "fit": "fit"}
"""What a legend says of a law."""

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a record"),
    "m": ("d^2", "mean square displacement M"),
    "a": ("rad^2", "mean square rotation A"),
    "m_fit": ("d^2", "the fit to M"),
    "a_fit": ("rad^2", "the fit to A"),
    "m_early": ("d^2", "e^(2 omega_i t) sin^2(omega_r t), scaled to the first turns of M"),
    "a_early": ("rad^2", "the same, scaled to the first turns of A"),
    "turns_from": ("t_0", "time at which the panels of late turns begin"),
    "growth_error": ("1", "fitted omega_i of M over that of the pair, minus 1"),
    "frequency_error": ("1", "fitted omega_r of M over that of the pair, minus 1"),
    **END_TIME,
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of the run without damping, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    return joined((_rows(state) for state in one_released_state(releases, options)), COLUMNS)


def _rows(state: ReleasedState) -> pd.DataFrame:
    names = {"time": "time", "m": "mean_square_displacement", "a": "mean_square_rotation"}
    rows = state.records(names)
    for column, (name, _, _) in QUANTITIES.items():
        rows[f"{column}_fit"] = _fit(state, name, rows["time"].to_numpy())
        rows[f"{column}_early"] = _early(rows, column)
    for column, name in (("growth", "rate"), ("frequency", "frequency")):
        fitted = state.first(f"displacement_{name}")
        rows[f"{column}_error"] = fitted / state.values(f"{name}_linear") - 1.0
    rows["turns_from"] = rows["time"].where(rows["m"] > DENSE_RECORDS_ONSET).min()
    return rows.assign(end_time=state.first("end_time"))


def _early(rows: pd.DataFrame, column: str) -> pd.Series:
    """C (13) with the pair's ω_i and ω_r in the first turns, NaN later."""
    first = rows["time"] <= SHOWN_TURNS * 2.0 * np.pi / rows["frequency"].iloc[0]
    shape = np.sin(rows["frequency"] * rows["time"]) ** 2 * np.exp(
        2.0 * rows["rate"] * rows["time"]
    )
    size = (shape * rows[column])[first].sum() / (shape**2)[first].sum()
    return (size * shape).where(first)


def _fit(state: ReleasedState, name: str, time: np.ndarray) -> np.ndarray:
    """The fitted oscillation that grows, at these times."""
    rate, frequency, size, depth, phase = (
        state.first(f"{name}_{part}") for part in ("rate", "frequency", "size", "depth", "phase")
    )
    swing = 1.0 + depth * np.cos(2.0 * frequency * time - phase)
    with np.errstate(over="ignore"):
        return size * np.exp(2.0 * rate * time) * swing


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Mean square displacement M(t) and mean square rotation A(t), C (29), (30), of a released "
        "complex pair: (a), (b) the first turns, circles from the dynamics, line a e^(2 ω_i t) "
        "sin²(ω_r t) with ω_i and ω_r of the pair; (c), (d) the whole growth, dots from the "
        "dynamics, line e^(2 ω_i t) of the pair; (e), (f) late turns, circles from the dynamics, "
        "line the fitted oscillation that grows. The numbers above say how far the fitted ω_i and "
        "ω_r are from those of the pair.",
        "the motion has the frequency and the growth rate of the pair; M and A return to 0 in the "
        "first turns alone, because later every grain moves on an ellipse.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the panels, M on the left and A on the right."""
    figure.set_size_inches(7.0, 6.8)
    panels = figure.subplots(3, 2)
    start = table["turns_from"].iloc[0]
    for place, (column, (_, symbol, unit)) in enumerate(QUANTITIES.items()):
        early, growth, late = panels[:, place]
        _draw_turns(early, table[table[f"{column}_early"].notna()], column, "early", 0.0)
        _draw_growth(growth, table, column)
        _draw_turns(late, _late_turns(table), column, "fit", start)
        for axes, number, title in (
            (early, place, "first turns"),
            (growth, 2 + place, "growth"),
            (late, 4 + place, "late turns"),
        ):
            labels.name_panel(axes, number, f"{symbol}, {title}")
        growth.set_ylabel(f"{symbol} / {unit}")
    errors = rf"fit of $M$: $\omega_i$ {_percent(table, 'growth_error')}, "
    errors += rf"$\omega_r$ {_percent(table, 'frequency_error')} off the pair"
    figure.suptitle(f"{release_caption(table)}\n{errors}")


def _percent(table: pd.DataFrame, column: str) -> str:
    return f"{100.0 * table[column].iloc[0]:.2g} %"


def _late_turns(table: pd.DataFrame) -> pd.DataFrame:
    """The records of the turns from `turns_from` on."""
    turn = 2.0 * np.pi / table["frequency"].iloc[0]
    shown = table[in_growth_range(table["m"].to_numpy())]
    start = table["turns_from"].iloc[0]
    return shown[shown["time"].between(start, start + SHOWN_TURNS * turn)]


def _draw_turns(axes: Axes, shown: pd.DataFrame, column: str, law: str, start: float) -> None:
    """Draw some turns and their law, in units of a power of ten."""
    _, symbol, unit = QUANTITIES[column]
    if not len(shown):
        return
    time = shown["time"] - start
    decade = 10.0 ** np.floor(np.log10(shown[column].max()))
    axes.plot(time, shown[column] / decade, "o", color="k", ms=2.5, mfc="none", label="dynamics")
    axes.plot(time, shown[f"{column}_{law}"] / decade, color=TRANSLATIONAL, label=LAW_WORDS[law])
    origin = rf"(t - {start:.0f}\,t_0)" if start else "t"
    top = 1.35 * shown[column].max() / decade
    axes.set(xlabel=rf"${origin} / t_0$", ylim=(0.0, top))
    axes.set_ylabel(rf"{symbol} / ${labels.power(decade)}$ {unit}")
    axes.legend(loc="upper left", ncols=2)


def _draw_growth(axes: Axes, table: pd.DataFrame, column: str) -> None:
    """Draw the growth, and e^(2 ω_i t) of the pair through its mean."""
    shown = growing_records(table)
    time = shown["rate"] * shown["time"]
    axes.semilogy(time, shown[column], ".", color="k", ms=1.6, label="dynamics")
    style = {"color": TRANSLATIONAL, "label": r"$e^{2 \omega_i t}$ of the pair"}
    axes.semilogy(time, growth_line(shown, column, 2.0), **style)
    axes.set_xlabel(r"$\omega_i t$")
    axes.legend(loc="upper left")
