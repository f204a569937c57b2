"""Contacts along the release of a complex pair, and by grain before and after it: C, Fig. 9.

(a) mean number of contacts of a grain and (b) number of contacts at Coulomb's threshold, C (8),
against time; vertical lines: end of the growth (dashed) and second instability (dotted). (c) P(z),
the fraction of the grains with z contacts, squares before and circles after the release.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import AFTER, BEFORE
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.release_rows import (
    END_TIME,
    RUN,
    SECOND_TIME,
    ReleasedState,
    mark_end_and_second,
    one_released_state,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "kind": ("", "record: a time of the run; grains: a number of contacts"),
    "time": ("t_0", "time of a record"),
    "contact_number": ("1", "mean number of contacts of a grain"),
    "sliding": ("1", "contacts at Coulomb's threshold"),
    "z": ("1", "a number of contacts"),
    "before": ("1", "fraction of the grains with z contacts at the start"),
    "after": ("1", "fraction of the grains with z contacts at the end"),
    **END_TIME,
    **SECOND_TIME,
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of the run without damping, then the fractions of grains, with `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    return joined((_rows(state) for state in one_released_state(releases, options)), COLUMNS)


def _rows(state: ReleasedState) -> pd.DataFrame:
    quantities = {"time": "time", "contact_number": "contact_number", "sliding": "sliding"}
    records = state.records(quantities).assign(kind="record")
    before, after = (state.values(f"contacts_{side}").astype(int) for side in ("before", "after"))
    largest = max(before.max(), after.max())
    grains = state.identity() | {
        "kind": "grains",
        "z": np.arange(largest + 1),
        "before": np.bincount(before, minlength=largest + 1) / len(before),
        "after": np.bincount(after, minlength=largest + 1) / len(after),
    }
    rows = pd.concat([records, pd.DataFrame(grains)], ignore_index=True)
    return rows.assign(end_time=state.first("end_time"), second_time=state.first("second_time"))


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Contacts along a release of one state: (a) mean number of contacts of a grain, (b) "
        "number of contacts at Coulomb's threshold, against time; dashed line: end of the growth, "
        "dotted: second instability. (c) Fraction P(z) of the grains with z contacts, squares "
        "before and circles after the release.",
        "contacts are lost in the second instability, and P(z) moves to smaller z.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the three panels."""
    figure.set_size_inches(7.0, 3.0)
    number, sliding, fractions = figure.subplots(1, 3)
    records, grains = (table[table["kind"] == kind] for kind in ("record", "grains"))
    _draw_records(number, 0, records, "contact_number", "contacts of a grain", "contacts")
    _draw_records(sliding, 1, records, "sliding", "sliding contacts", "at the threshold")
    figure.legend(*number.get_legend_handles_labels(), loc="outside lower left", ncols=2)
    _draw_fractions(fractions, grains)
    figure.suptitle(release_caption(table))


def _draw_records(
    axes: Axes, index: int, records: pd.DataFrame, column: str, label: str, title: str
) -> None:
    records = records[records["time"] > 0.0]
    axes.plot(records["time"], records[column], ".", color="k", ms=1.2)
    mark_end_and_second(axes, records, in_legend=index == 0)
    axes.set(xscale="log", xlabel="$t / t_0$", ylabel=label)
    labels.name_panel(axes, index, title)


def _draw_fractions(axes: Axes, grains: pd.DataFrame) -> None:
    for side, colour, marker in (("before", BEFORE, "s"), ("after", AFTER, "o")):
        axes.plot(grains["z"], grains[side], f"{marker}-", color=colour, mfc="none", label=side)
    axes.set(xlabel="$z$", ylabel="$P(z)$")
    labels.name_panel(axes, 2, "grains with $z$ contacts")
    axes.legend(loc="best")
