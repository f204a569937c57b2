"""Pressures of contacts and of grains before and after a release (C, Fig. 10)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.release_rows import AFTER, BEFORE, Sample, caption, one
from grainmodes.figures.shared.release_rows import COLUMNS as RUN
from grainmodes.figures.shared.selection import Options

BINS = 30
"""Bins of the distribution of r · f, from 0 to the largest."""

STYLES = {"before": (BEFORE, "s"), "after": (AFTER, "o")}

WORK = {"hertz": r"$(k_N d^{5/2})$", "harmonic": "$(k_N d^2)$"}
"""Unit of r · f under each normal contact law."""

COLUMNS = {
    **RUN,
    "side": ("", "before: the start of the run; after: its end"),
    "kind": ("", "contacts: a bin of r . f; grains: a number of contacts z"),
    "binary": ("k_N d^2", "middle of a bin of P_ij = r . f"),
    "density": ("1/(k_N d^2)", "probability density of P_ij"),
    "count": ("1", "contacts in the bin, or grains with z contacts"),
    "z": ("1", "number of contacts"),
    "pressure": ("k_N", "mean P_i of the grains with z contacts"),
    "pressure_error": ("k_N", "its standard error"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """Rows of bins, then rows of numbers of contacts, for both sides, with `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi, kt or seed asked for.
    """
    return joined((_rows(sample) for sample in one(releases, options)), COLUMNS)


def _rows(sample: Sample) -> pd.DataFrame:
    known = {side: sample.of(f"binary_pressure_{side}") for side in STYLES}
    known = {side: values[np.isfinite(values)] for side, values in known.items()}
    edges = np.linspace(0.0, max(values.max() for values in known.values()), BINS + 1)
    parts = [
        part
        for side, values in known.items()
        for part in (_density(values, edges, side), _by_contacts(sample, side))
    ]
    return pd.concat(parts, ignore_index=True).assign(**sample.columns())


def _density(values: np.ndarray, edges: np.ndarray, side: str) -> pd.DataFrame:
    count = np.histogram(values, edges)[0]
    middle = 0.5 * (edges[:-1] + edges[1:])
    density = count / len(values) / np.diff(edges)
    row = {"side": side, "kind": "contacts", "binary": middle, "density": density, "count": count}
    return pd.DataFrame(row)


def _by_contacts(sample: Sample, side: str) -> pd.DataFrame:
    z, pressure = sample.of(f"contacts_{side}"), sample.of(f"grain_pressure_{side}")
    groups = pd.DataFrame({"z": z, "pressure": pressure}).groupby("z")["pressure"]
    return pd.DataFrame(
        {
            "side": side,
            "kind": "grains",
            "pressure": groups.mean(),
            "pressure_error": groups.sem(),
            "count": groups.size(),
        }
    ).reset_index()


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a) the distribution of P_ij, (b) mean P_i against z."""
    figure.set_size_inches(7.0, 2.9)
    contacts, grains = figure.subplots(1, 2)
    for side, (colour, marker) in STYLES.items():
        of = table[table["side"] == side]
        _distribution(contacts, of[of["kind"] == "contacts"], side, colour, marker)
        mean = of[of["kind"] == "grains"]
        style = {"fmt": f"{marker}-", "color": colour, "mfc": "none", "label": side}
        grains.errorbar(mean["z"], mean["pressure"], mean["pressure_error"], **style)
    unit = WORK[table["law"].iloc[0]]
    contacts.set(xlabel=f"$P_{{ij}}$ / {unit}", ylabel="probability density", yscale="log")
    grains.set(xlabel="$z$", ylabel=appearance.modulus_label("$P_i$", table))
    for place, (axes, name) in enumerate(((contacts, "contacts"), (grains, "grains"))):
        appearance.name_panel(axes, place, name)
        axes.legend(loc="best")
    figure.suptitle(caption(table, "bars: standard error"))


def _distribution(axes: Axes, of: pd.DataFrame, side: str, colour: str, marker: str) -> None:
    filled = of[of["count"] > 0]
    axes.plot(filled["binary"], filled["density"], marker, color=colour, mfc="none", label=side)
