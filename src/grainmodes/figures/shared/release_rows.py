"""The sample of the figures of a release, and its rows, from the files of `grainmodes release`."""

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

PAPER_N = 500

RUN = {
    **POINT,
    **LAW,
    **SEED,
    "rate": ("1/t_0", "omega_i of the pair"),
    "frequency": ("1/t_0", "omega_r of the pair"),
    "damping": ("1/t_0", "eta_0 of the run"),
}
"""Columns that say which run of which sample a row is about."""

END_TIME = {"end_time": ("t_0", "time at which M leaves its fit")}
SECOND_TIME = {"second_time": ("t_0", "time at which the second instability begins")}

SHOWN_GROWTH = 1.3
"""Duration for which a growth is shown, in units of its end."""


class ReleasedSample(NamedTuple):
    """One released sample: a row of a block."""

    block: Block
    row: int

    def values(self, name: str) -> np.ndarray:
        """The values of the variable `release_name`; empty where the file lacks the variable."""
        array = self.block.variables.get(f"release_{name}")
        return np.zeros(0) if array is None else array[self.row]

    def first(self, name: str) -> float:
        """The value of a variable for the run without damping, which is the first one."""
        return self.values(name)[0]

    @property
    def seed(self) -> int:
        """Seed of the sample."""
        return int(self.block.variables["seed"][self.row])

    def identity(self, run: int = 0) -> dict[str, object]:
        """The values of the columns `RUN` for one of its runs."""
        identity = point_of(self.block) | law_values(law_of(self.block)) | {"seed": self.seed}
        pair = {name: float(self.values(f"{name}_linear")) for name in ("rate", "frequency")}
        return identity | pair | {"damping": float(self.values("damping")[run])}

    def records(self, names: dict[str, str], run: int = 0) -> pd.DataFrame:
        """A row per recorded time of a run, with the columns `RUN`.

        Args:
            names: column → quantity.
        """
        known = np.isfinite(self.values("time")[run])
        series = {column: self.values(name)[run][known] for column, name in names.items()}
        return pd.DataFrame(self.identity(run) | series)


def released_samples(blocks: list[Block], options: Options) -> list[ReleasedSample]:
    """The released samples of the requested N, φ and k_T, by seed; without a request those of the
    N nearest to C's, and of the largest φ and k_T.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    released = [block for block in blocks if np.any(block.variables.get("release_found", 0))]
    samples = [
        ReleasedSample(block, row)
        for block in at_kt(at_point(released, options, PAPER_N), options)
        for row in np.flatnonzero(block.variables["release_found"])
    ]
    return sorted(samples, key=lambda sample: sample.seed)


def one_released_sample(blocks: list[Block], options: Options) -> list[ReleasedSample]:
    """The sample of the requested seed, else the first; an empty list if none was released.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    samples = released_samples(blocks, options)
    if not samples:
        return []
    seed = smallest_or(options.seed, np.array([sample.seed for sample in samples]), "seed")
    return [sample for sample in samples if sample.seed == seed]


def growing_records(records: pd.DataFrame) -> pd.DataFrame:
    """The records of one run until a little after the end of its growth; all if it has no end."""
    end = np.nan_to_num(records["end_time"].iloc[0], nan=np.inf)
    return records[(records["time"] > 0.0) & (records["time"] < SHOWN_GROWTH * end)]


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
