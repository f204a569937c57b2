"""When the growth of released states ends, against their growth rate: C, Sec. VI B (3).

(a) times of the end of the growth (circles), of the first change of contacts (crosses), of the
death of the released pair (triangles) and of the second instability (squares), against ω_i; line:
slope −1 through the median end. (b) M at the end of the growth and at the first change of contacts;
dashed: C's 1e-7. A symbol per released state.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import BLUE, RED
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.release_rows import (
    END_TIME,
    RUN,
    SECOND_TIME,
    ReleasedState,
    released_states,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

PAPER_SQUARE = 1e-7
"""M at which growth ends, C, Fig. 6, in d²."""

COLUMNS = {
    **RUN,
    **END_TIME,
    "change_time": ("t_0", "time of the first change of contacts"),
    "death_time": ("t_0", "time at which the released pair has died"),
    **SECOND_TIME,
    "end_square": ("d^2", "M at the end of the growth"),
    "change_square": ("d^2", "M at the first change of contacts"),
}

STYLES = {
    "second_time": ("s", BLUE, "second instability"),
    "end_time": ("o", "k", "end of the growth"),
    "change_time": ("x", RED, "first change of contacts"),
    "death_time": ("^", "0.5", "death of the pair"),
}
"""Column → symbol, colour and words."""


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """A row per released state, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    return joined((_row(state) for state in released_states(releases, options)), COLUMNS)


def _row(state: ReleasedState) -> pd.DataFrame:
    runs = ("end_time", "change_time", "second_time", "end_square", "change_square")
    values = {name: state.first(name) for name in runs}
    followed = state.values("death_time")  # none without spectra
    values["death_time"] = float(followed) if followed.size else np.nan
    return pd.DataFrame([state.identity() | values])


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Released states without damping, a symbol per state, against ω_i of their pair: (a) times "
        "at which the growth ends (circles), contacts first change (crosses), the released pair "
        "dies (triangles) and the second instability begins (squares), with a line of slope −1; "
        "(b) M at the end of the growth and at the first change of contacts; dashed: C's 1e-7.",
        "the growth ends at a time proportional to 1/ω_i, when contacts change and the pair dies; "
        "the second instability does not follow 1/ω_i.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both panels."""
    figure.set_size_inches(7.0, 3.4)
    times, squares = figure.subplots(1, 2)
    for column, (marker, colour, words) in STYLES.items():
        style = {"color": colour, "mfc": "none", "ms": 4.5}
        times.plot(table["rate"], table[column], marker, label=words, **style)
        square = column.replace("time", "square")
        if square in table:
            squares.plot(table["rate"], table[square], marker, **style)
    ends = np.array([table["rate"].min(), table["rate"].max()])
    height = np.exp(np.log(table["rate"] * table["end_time"]).median())
    times.plot(ends, height / ends, "k-", lw=0.8, label="slope $-1$")
    squares.axhline(PAPER_SQUARE, color="0.5", ls="--", lw=0.8)
    times.set(ylabel="$t / t_0$")
    squares.set(ylabel="$M / d^2$")
    for index, (axes, title) in enumerate(
        ((times, "times"), (squares, "mean square displacement"))
    ):
        axes.set(xscale="log", yscale="log", xlabel=r"$\omega_i t_0$")
        labels.name_panel(axes, index, title)
    figure.legend(*times.get_legend_handles_labels(), loc="outside lower center", ncols=5)
    samples = labels.count_samples([table["seed"].nunique()])
    states = labels.count_samples([len(table)], "state")
    figure.suptitle(", ".join([*labels.constants(table), samples, states]))
