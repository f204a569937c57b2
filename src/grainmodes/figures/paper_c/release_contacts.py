"""Contacts along a release, at Coulomb's threshold, and by grain before and after (C, Fig. 9)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.release_rows import AFTER, BEFORE, Sample, caption, mark_moments, one
from grainmodes.figures.shared.release_rows import COLUMNS as RUN
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "kind": ("", "record: a time of the run; grains: a number of contacts"),
    "time": ("t_0", "time of a record"),
    "contact_number": ("1", "mean number of contacts of a grain"),
    "sliding": ("1", "contacts at Coulomb's threshold"),
    "z": ("1", "a number of contacts"),
    "before": ("1", "share of the grains with z contacts at the start"),
    "after": ("1", "share of the grains with z contacts at the end"),
    "end_time": ("t_0", "when M leaves its law"),
    "second_time": ("t_0", "when the second instability begins"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """The records of the run without damping, then the shares of grains, with `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi, kt or seed asked for.
    """
    return joined((_rows(sample) for sample in one(releases, options)), COLUMNS)


def _rows(sample: Sample) -> pd.DataFrame:
    quantities = {"time": "time", "contact_number": "contact_number", "sliding": "sliding"}
    records = sample.records(quantities).assign(kind="record")
    z = [sample.of(f"contacts_{side}").astype(int) for side in ("before", "after")]
    most = max(part.max() for part in z)
    shares = [np.bincount(part, minlength=most + 1) / len(part) for part in z]
    grains = {"kind": "grains", "z": np.arange(most + 1), "before": shares[0], "after": shares[1]}
    rows = pd.concat([records, pd.DataFrame(sample.columns() | grains)], ignore_index=True)
    return rows.assign(end_time=sample.of("end_time")[0], second_time=sample.of("second_time")[0])


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a) contacts of a grain, (b) sliding contacts against time; (c) shares of grains."""
    figure.set_size_inches(7.0, 2.7)
    number, sliding, shares = figure.subplots(1, 3)
    records, grains = (table[table["kind"] == kind] for kind in ("record", "grains"))
    for place, (axes, column, label) in enumerate(
        (
            (number, "contact_number", "contacts of a grain"),
            (sliding, "sliding", "sliding contacts"),
        )
    ):
        axes.plot(records["time"], records[column], ".", color="k", ms=1.2)
        mark_moments(axes, records, label=place == 0)
        axes.set(xlabel="$t / t_0$", ylabel=label)
        appearance.name_panel(axes, place, ("contacts", "at the threshold")[place])
    number.legend(loc="lower left")
    _shares(shares, grains)
    figure.suptitle(caption(table))


def _shares(axes: Axes, grains: pd.DataFrame) -> None:
    for side, colour, marker in (("before", BEFORE, "s"), ("after", AFTER, "o")):
        axes.plot(grains["z"], grains[side], f"{marker}-", color=colour, mfc="none", label=side)
    axes.set(xlabel="$z$", ylabel="$P(z)$")
    appearance.name_panel(axes, 2, "grains with $z$ contacts")
    axes.legend(loc="best")
