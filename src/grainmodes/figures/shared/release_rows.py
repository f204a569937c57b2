"""The released states of the figures, and their rows, from the files of `grainmodes release`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.columns import LAW, POINT, SEED, law_values
from grainmodes.figures.shared.sample_files import at_kt, at_point, law_of, point_of
from grainmodes.figures.shared.selection import Options, smallest_or
from grainmodes.parameters.release import GROWTH_RANGE

PAPER_N = 500

PAPER_RATE = 2.28e-5
"""ω_i, in 1/t_0, of the state that C shows in its Figs. 7 (b), 8 and 11."""

RUN = {
    **POINT,
    **LAW,
    **SEED,
    "rate": ("1/t_0", "omega_i of the pair"),
    "frequency": ("1/t_0", "omega_r of the pair"),
    "damping": ("1/t_0", "eta_0 of the run"),
}
"""Columns that say which run of which state a row is about."""

END_TIME = {"end_time": ("t_0", "time at which M leaves its fit")}
SECOND_TIME = {"second_time": ("t_0", "time at which the second instability begins")}

SHOWN_GROWTH = 1.3
"""Duration for which a growth is shown, in units of its end."""


class ReleasedState(NamedTuple):
    """One released state: a place in a row of a block."""

    block: Block
    row: int
    place: int

    def values(self, name: str) -> np.ndarray:
        """The values of the variable `release_name`; empty where the file lacks the variable."""
        array = self.block.variables.get(f"release_{name}")
        return np.zeros(0) if array is None else array[self.row, self.place]

    def first(self, name: str) -> float:
        """The value of a variable for the run without damping, which is the first one."""
        return float(self.values(name)[0])

    @property
    def seed(self) -> int:
        """Seed of the sample."""
        return int(self.block.variables["seed"][self.row])

    @property
    def rate(self) -> float:
        """ω_i of the pair, in 1/t_0."""
        return float(self.values("rate_linear"))

    @property
    def damped_motion(self) -> str:
        """What the dampings of the runs damp: "translations" or "all" motion."""
        return str(self.block.mapping("config")["release"]["damped_motion"])

    def identity(self, run: int = 0) -> dict[str, object]:
        """The values of the columns `RUN` for one of its runs."""
        identity = point_of(self.block) | law_values(law_of(self.block)) | {"seed": self.seed}
        pair = {"rate": self.rate, "frequency": float(self.values("frequency_linear"))}
        return identity | pair | {"damping": float(self.values("damping")[run])}

    def records(self, names: dict[str, str], run: int = 0) -> pd.DataFrame:
        """A row per recorded time of a run, with the columns `RUN`.

        Args:
            names: column → quantity.
        """
        known = np.isfinite(self.values("time")[run])
        series = {column: self.values(name)[run][known] for column, name in names.items()}
        return pd.DataFrame(self.identity(run) | series)


def released_states(blocks: list[Block], options: Options) -> list[ReleasedState]:
    """The released states of the requested N, φ and k_T, ω_i descending; without a request those of
    the N nearest to C's, and of the largest φ and k_T.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    released = [block for block in blocks if np.any(block.variables.get("release_found", 0))]
    states = [
        ReleasedState(block, row, place)
        for block in at_kt(at_point(released, options, PAPER_N), options)
        for row, place in np.argwhere(block.variables["release_found"]).tolist()
    ]
    return sorted(states, key=lambda state: -state.rate)


def one_released_state(blocks: list[Block], options: Options) -> list[ReleasedState]:
    """The state whose ω_i is nearest to that of C, of all samples or of the one that is requested;
    an empty list if none was released.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    states = released_states(blocks, options)
    if not states:
        return []
    if options.seed is not None:
        seed = smallest_or(options.seed, np.unique([state.seed for state in states]), "seed")
        states = [state for state in states if state.seed == seed]
    return [min(states, key=lambda state: abs(np.log(state.rate / PAPER_RATE)))]


def growing_records(records: pd.DataFrame) -> pd.DataFrame:
    """The records of one run until a little after the end of its growth; all if it has no end."""
    end = np.nan_to_num(records["end_time"].iloc[0], nan=np.inf)
    return records[(records["time"] > 0.0) & (records["time"] < SHOWN_GROWTH * end)]


def growth_line(records: pd.DataFrame, column: str, exponent: float) -> pd.Series:
    """e^(exponent ω_i t) through the geometric mean of a positive column in the range of the fit.

    NaN where it leaves the values of the column by far.
    """
    time, values = records["rate"] * records["time"], records[column]
    used = records["m"].between(*GROWTH_RANGE) & (values > 0.0)
    size = np.mean(np.log(values[used]) - exponent * time[used]) if used.any() else np.nan
    line = np.exp(size + exponent * time)
    return line.where(line.between(values[values > 0.0].min(), 10.0 * values.max()))


def release_caption(table: pd.DataFrame, *parts: str) -> str:
    """The sample that is shown, ω_r and ω_i of its pair, then further parts."""
    frequency, rate = table["frequency"].iloc[0], table["rate"].iloc[0]
    pair = rf"$\omega_r = {frequency:.4g}$, $\omega_i = {labels.power(rate, 2)}$"
    return labels.sample_caption(table, pair, *parts)


def mark_end_and_second(axes: Axes, table: pd.DataFrame, in_legend: bool = False) -> None:
    """Draw vertical lines at the end of the growth (dashed) and at the second instability
    (dotted), where the run has them."""
    for column, dash, words in (
        ("end_time", "--", "growth ends"),
        ("second_time", ":", "second instability"),
    ):
        time = table[column].iloc[0]
        if np.isfinite(time):
            style = {"color": "0.35", "lw": 0.8, "ls": dash, "zorder": 0}
            axes.axvline(time, label=words if in_legend else None, **style)
