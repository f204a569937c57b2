"""Rows of the figures of released states, from the files of `grainmodes release`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.event_detail_rows import SAMPLE
from grainmodes.figures.shared.field_rows import at_kt, at_point
from grainmodes.figures.shared.selection import Options, first_or

PAPER_N = 500

COLUMNS = {
    **SAMPLE,
    "rate": ("1/t_0", "omega_i of the pair"),
    "frequency": ("1/t_0", "omega_r of the pair"),
    "damping": ("1/t_0", "eta_0 of the run"),
}
"""Columns that say which run of which sample a row is about."""

SHOWN = 1.3
"""How long a growth is shown, in units of its end."""

BEFORE, AFTER = appearance.ROTATIONAL, appearance.TRANSLATIONAL
"""Colours of the start of a run and of its end."""


class Sample(NamedTuple):
    """One released sample: a row of a block."""

    block: Block
    row: int

    def of(self, name: str) -> np.ndarray:
        """Its values of a variable; none where its file lacks the variable."""
        values = self.block.variables.get(f"release_{name}")
        return np.zeros(0) if values is None else values[self.row]

    @property
    def seed(self) -> int:
        """Its seed."""
        return int(self.block.variables["seed"][self.row])

    def columns(self, run: int = 0) -> dict[str, object]:
        """The values of `COLUMNS` for one of its runs."""
        point = {name: self.block.attributes[name] for name in ("n", "phi", "kt")}
        law = self.block.mapping("config")["law"]["normal"]
        pair = {name: float(self.of(f"{name}_linear")) for name in ("rate", "frequency")}
        damping = float(self.of("damping")[run])
        return point | {"law": law, "seed": self.seed} | pair | {"damping": damping}

    def records(self, names: dict[str, str], run: int = 0) -> pd.DataFrame:
        """A row per record of a run, in time, with `COLUMNS`; names: column → quantity."""
        known = np.isfinite(self.of("time")[run])
        series = {column: self.of(name)[run][known] for column, name in names.items()}
        return pd.DataFrame(self.columns(run) | series)


def samples(blocks: list[Block], options: Options) -> list[Sample]:
    """The released samples of the N, φ and k_T asked for, else of the N nearest to C's; by seed."""
    having = [block for block in blocks if block.variables["release_found"].any()]
    found = [
        Sample(block, row)
        for block in at_kt(at_point(having, options, PAPER_N), options)
        for row in np.flatnonzero(block.variables["release_found"])
    ]
    return sorted(found, key=lambda sample: sample.seed)


def one(blocks: list[Block], options: Options) -> list[Sample]:
    """The sample asked for, else the first; none if none was released."""
    found = samples(blocks, options)
    if not found:
        return []
    seed = first_or(options.seed, np.array([sample.seed for sample in found]), "seed")
    return [sample for sample in found if sample.seed == seed]


def growing(table: pd.DataFrame) -> pd.DataFrame:
    """The records of one run until a little after the end of its growth; all if it has none."""
    end = np.nan_to_num(table["end_time"].iloc[0], nan=np.inf)
    return table[(table["time"] > 0.0) & (table["time"] < SHOWN * end)]


def caption(table: pd.DataFrame, *parts: str) -> str:
    """Which sample is shown, its pair, and more."""
    names = [appearance.CONSTANTS[name](table[name].iloc[0]) for name in ("n", "phi", "kt")]
    frequency, rate = table["frequency"].iloc[0], table["rate"].iloc[0]
    pair = rf"$\omega_r = {frequency:.4g}$, $\omega_i = {appearance.power(float(f'{rate:.2g}'))}$"
    return ", ".join([*names, f"seed {table['seed'].iloc[0]}", pair, *parts])


def mark_moments(axes: Axes, table: pd.DataFrame, label: bool = False) -> None:
    """Dashed lines at the end of the growth and at the second instability, where they were."""
    for column, words in (("end", "growth ends"), ("second", "second instability")):
        time = table[f"{column}_time"].iloc[0]
        if np.isfinite(time):
            style = {"color": "0.35", "lw": 0.8, "ls": "--" if column == "end" else ":"}
            axes.axvline(time, label=words if label else None, zorder=0, **style)
