"""|λ1 − λ2| against |γ − γ_c| where two eigenvalues meet and part again (C, Fig. 4).

Real eigenvalues, before a birth and after a death; on the other side they are a pair. A line of
slope 1/2 has the height of the median point.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.exceptional import PairSample, pair_samples
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.paired_samples import EIGENVALUE, SAMPLE_COLUMNS, UNIT
from grainmodes.figures.shared.selection import Options

COLUMNS = SAMPLE_COLUMNS | {
    "birth": ("1", "1: a birth, 0: a death"),
    "point": ("1", "number of the point in its sample"),
    "pair": ("1", "1 where the two are a complex pair"),
    "distance": ("1", "distance |strain - gamma_c| of the state"),
    "difference": (EIGENVALUE, "|lambda_1 - lambda_2|"),
}
SIDES = (
    (1, "birth: as they come to $\\gamma_{c1}$"),
    (0, "death: as they part from $\\gamma_{c2}$"),
)
OF_LINE = np.array([1e-8, 1e-5])


def table(ensemble, options: Options) -> pd.DataFrame:
    """A row per state around an exceptional point, with the columns `COLUMNS`; of every N if asked
    for none.

    Raises:
        BlockError: its study did not ask for complex pairs.
    """
    found = [s for s in pair_samples(ensemble) if options.n in (None, s.coordinates["n"])]
    parts = [_rows(sample) for sample in found]
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=list(COLUMNS))


def _rows(sample: PairSample) -> pd.DataFrame:
    born = sample.exceptional_points["birth"]
    near = sample.neighbours[sample.neighbours["point"].isin(born.index)]
    return near.assign(
        **sample.coordinates,
        birth=born.loc[near["point"].astype(int)].to_numpy(),
        pair=(near["discriminant"] < 0.0).astype(int),
        distance=near["distance"].abs(),
        difference=np.sqrt(near["discriminant"].abs()),
    )[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Left births, right deaths, one line each; colours are N."""
    figure.set_size_inches(7.0, 3.1)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for index, (axes, (birth, name)) in enumerate(zip(panels, SIDES, strict=True)):
        _panel(axes, table[(table["birth"] == birth) & (table["pair"] == 0)])
        appearance.name_panel(axes, index, name)
        axes.set(xlabel=r"$|\gamma - \gamma_c|$")
    panels[0].set(ylabel=rf"$|\lambda_1 - \lambda_2|$ / ({UNIT})")
    panels[0].legend(loc="lower right")


def _panel(axes: Axes, rows: pd.DataFrame) -> None:
    axes.set(xscale="log", yscale="log")
    for n, colour, marker in appearance.series(sorted(rows["n"].unique())):
        of_n = rows[rows["n"] == n]
        for _, of in of_n.groupby(["seed", "point"]):
            axes.plot(of["distance"], of["difference"], marker + "-", color=colour, **THIN)
        appearance.add_to_legend(axes, f"$N = {n:.0f}$", colour, marker)
    if len(rows):
        height = np.exp(np.median(np.log(rows["difference"] / np.sqrt(rows["distance"]))))
        axes.plot(OF_LINE, height * np.sqrt(OF_LINE), "k-", lw=1.2, label="slope 1/2")


THIN = {"markersize": 2.0, "lw": 0.5, "mew": 0.5, "mfc": "none"}
"""Many curves in one panel."""
