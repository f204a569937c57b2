"""Pressures of contacts and of grains before and after a release: C, Fig. 10.

(a) probability density of P_ij = r · f of the contacts, (b) mean pressure P_i of the grains with z
contacts, with standard errors; squares before, circles after the release.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import AFTER, BEFORE
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import ENERGY_UNIT, RIGIDITY_UNIT
from grainmodes.figures.shared.release_rows import (
    RUN,
    ReleasedState,
    one_released_state,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

BINS = 30
"""Number of bins of the distribution of r · f, from 0 to the largest value."""

STYLES = {"before": (BEFORE, "s"), "after": (AFTER, "o")}

WORK_UNIT = {"hertz": r"$(k_N d^{5/2})$", "harmonic": "$(k_N d^2)$"}
"""Unit of r · f under each normal contact law."""

COLUMNS = {
    **RUN,
    "side": ("", "before: the start of the run; after: its end"),
    "kind": ("", "contacts: a bin of r . f; grains: a number of contacts z"),
    "binary": (ENERGY_UNIT, "middle of a bin of P_ij = r . f"),
    "density": (f"1/({ENERGY_UNIT})", "probability density of P_ij"),
    "count": ("1", "contacts in the bin, or grains with z contacts"),
    "z": ("1", "number of contacts"),
    "pressure": (RIGIDITY_UNIT, "mean P_i of the grains with z contacts"),
    "pressure_error": (RIGIDITY_UNIT, "its standard error"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """Rows of bins, then rows of numbers of contacts, for both sides, with `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    return joined((_rows(state) for state in one_released_state(releases, options)), COLUMNS)


def _rows(state: ReleasedState) -> pd.DataFrame:
    pressures = {side: state.values(f"binary_pressure_{side}") for side in STYLES}
    pressures = {side: values[np.isfinite(values)] for side, values in pressures.items()}
    largest = max(values.max() for values in pressures.values())
    edges = np.linspace(0.0, largest, BINS + 1)
    parts = [
        part
        for side, values in pressures.items()
        for part in (_density_of_contacts(values, edges, side), _means_by_contacts(state, side))
    ]
    return pd.concat(parts, ignore_index=True).assign(**state.identity())


def _density_of_contacts(values: np.ndarray, edges: np.ndarray, side: str) -> pd.DataFrame:
    count = np.histogram(values, edges)[0]
    return pd.DataFrame(
        {
            "side": side,
            "kind": "contacts",
            "binary": 0.5 * (edges[:-1] + edges[1:]),
            "density": count / len(values) / np.diff(edges),
            "count": count,
        }
    )


def _means_by_contacts(state: ReleasedState, side: str) -> pd.DataFrame:
    z, pressure = state.values(f"contacts_{side}"), state.values(f"grain_pressure_{side}")
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


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Pressures before (squares) and after (circles) a release of one state: (a) probability "
        "density of P_ij = r·f of the contacts, (b) mean pressure P_i of the grains with z "
        "contacts; bars: standard errors over the grains.",
        "the longer tail of P_ij after the release, and P_i, which has risen at every z.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both panels."""
    figure.set_size_inches(7.0, 2.9)
    contacts, grains = figure.subplots(1, 2)
    for side, (colour, marker) in STYLES.items():
        rows = table[table["side"] == side]
        style = {"color": colour, "mfc": "none", "label": side}
        bins = rows[(rows["kind"] == "contacts") & (rows["count"] > 0)]
        contacts.plot(bins["binary"], bins["density"], marker, **style)
        mean = rows[rows["kind"] == "grains"]
        bars = mean["pressure_error"]
        grains.errorbar(mean["z"], mean["pressure"], bars, fmt=f"{marker}-", **style)
    unit = WORK_UNIT[table["law"].iloc[0]]
    contacts.set(xlabel=f"$P_{{ij}}$ / {unit}", ylabel="probability density", yscale="log")
    grains.set(xlabel="$z$", ylabel=labels.modulus_label("$P_i$", table))
    for index, (axes, name) in enumerate(((contacts, "contacts"), (grains, "grains"))):
        labels.name_panel(axes, index, name)
        axes.legend(loc="upper left" if axes is grains else "upper right")
    figure.suptitle(release_caption(table, "bars: standard error"))
