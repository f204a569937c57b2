"""Is the integral V of tangential velocities, B (10), tangential to the contact: B, Fig. 10.

Err = |V·n| / |V|, B (A1), is its normal part. Curves show the largest and the median Err of the
contacts against strain, on logarithmic axes: slope 1 is first order in the strain, slope 2 second
order.

B finds Err below 3e-16, the grey line. That is what a single increment has against its own normal;
the integral over a contact that turns has an Err of half the angle by which it has turned.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import BLUE, RED
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.event_rows import SAMPLE, rows_from_variables, sample_with
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

PAPER_N, PAPER_ERROR = 128, 3e-16

COLUMNS = {
    **SAMPLE,
    "strain": ("1", "strain"),
    "error_largest": ("1", "largest Err of a contact"),
    "error_median": ("1", "median Err of the contacts"),
    "error_increment": ("1", "largest Err of the last step alone, against its own normal"),
    "turn_median": ("rad", "median angle by which contacts have turned since they closed"),
    "length_median": ("1", "median relative difference of the length of the integral and s"),
}

CURVES = {
    "error_largest": ("largest Err", RED, "-"),
    "error_median": ("median Err", BLUE, "-"),
    "half_turn": ("half the median turn", "k", ":"),
    "length_median": (r"$\left||V| - |s|\right| / |s|$, median", "0.5", "-."),
    "error_increment": ("largest Err of one step", "#4d9221", "--"),
}
"""Column → its words in the legend, colour and dashes."""


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """A row per state of the shear up to the first event, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    variables = {column: f"path_{column}" for column in list(COLUMNS)[len(SAMPLE) :]}
    shown = sample_with("path_count", event_details, options, PAPER_N)
    return joined((rows_from_variables(block, variables) for block in shown), COLUMNS)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Err = |V·n|/|V|, B (A1), the normal part of the integral V of the tangential velocities "
        "of a contact, against strain, double logarithmic: largest and median of the contacts; "
        "dotted: half the median angle by which contacts have turned; dash-dotted: how far |V| is "
        "from the |s| of this package; dashed: Err of the last step alone; grey: the bound that B "
        "states.",
        "the median on the dotted line: Err is half the angle of turning, first order in the "
        "strain; only a single step lies at the grey line.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw all curves in one panel."""
    figure.set_size_inches(3.9, 3.4)
    axes = figure.subplots()
    states = table.assign(half_turn=table["turn_median"] / 2.0)
    for column, (label, colour, dash) in CURVES.items():
        shown = states[states[column] > 0.0]
        axes.plot(shown["strain"], shown[column], dash, color=colour, label=label)
    bound = r"paper: below $3 \times 10^{-16}$"
    axes.axhline(PAPER_ERROR, color="0.75", lw=2.5, zorder=0, label=bound)
    axes.set(xscale="log", yscale="log", xlabel=r"$\gamma$", ylabel="Err", ylim=(3e-17, 30.0))
    axes.legend(loc="center right", bbox_to_anchor=(1.0, 0.32))
    figure.suptitle(labels.sample_caption(table))
