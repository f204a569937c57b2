"""|λ1 − λ2| against |γ − γ_c| where two eigenvalues meet and part again, C (21): C, Fig. 4.

Left births, right deaths of complex pairs, on the side where the two are real. A line per
exceptional point, a colour per N. The black line of slope 1/2 has the height of the median state.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble import contact_law
from grainmodes.ensemble.exceptional import PairSample, pair_samples
from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import law_values
from grainmodes.figures.shared.pair_samples import EIGENVALUE_UNIT, SAMPLE
from grainmodes.figures.shared.selection import Options

COLUMNS = SAMPLE | {
    "birth": ("1", "1: a birth, 0: a death"),
    "point": ("1", "number of the exceptional point in its sample"),
    "pair": ("1", "1 where the two are a complex pair"),
    "distance": ("1", "distance |strain - gamma_c| of the state"),
    "difference": (EIGENVALUE_UNIT, "|lambda_1 - lambda_2|"),
}
PANELS = (
    (1, "birth: as they come to $\\gamma_{c1}$"),
    (0, "death: as they part from $\\gamma_{c2}$"),
)
LINE_ENDS = np.array([1e-8, 1e-5])
"""|γ − γ_c| at the ends of the line of slope 1/2."""

THIN = {"markersize": 2.0, "lw": 0.5, "mew": 0.5, "mfc": "none"}
"""Style of one of many curves in a panel."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """A row per state around an exceptional point, with the columns `COLUMNS`; of every N if none
    is requested.

    Raises:
        BlockError: the study did not request complex pairs.
    """
    shown = [
        sample for sample in pair_samples(ensemble) if options.n in (None, sample.coordinates["n"])
    ]
    law = law_values(contact_law(ensemble))
    parts = [_rows(sample).assign(**law)[list(COLUMNS)] for sample in shown]
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame(columns=list(COLUMNS))


def _rows(sample: PairSample) -> pd.DataFrame:
    birth = sample.exceptional_points["birth"]
    states = sample.neighbours[sample.neighbours["point"].isin(birth.index)]
    return states.assign(
        **sample.coordinates,
        birth=birth.loc[states["point"].astype(int)].to_numpy(),
        pair=(states["discriminant"] < 0.0).astype(int),
        distance=states["distance"].abs(),
        difference=np.sqrt(states["discriminant"].abs()),
    )


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "|λ1 − λ2| of two eigenvalues of M⁻¹J against the distance |γ − γ_c| to the strain at "
        "which they meet, double logarithmic, on the side where both are real: (a) births, (b) "
        "deaths of complex pairs. A line per exceptional point, a colour per number of grains N. "
        "Black line: slope 1/2 at the height of the median state.",
        "whether every line has the slope 1/2, at births and at deaths.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw births and deaths side by side."""
    figure.set_size_inches(7.0, 3.1)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for index, (axes, (birth, name)) in enumerate(zip(panels, PANELS, strict=True)):
        _panel(axes, table[(table["birth"] == birth) & (table["pair"] == 0)])
        labels.name_panel(axes, index, name)
        axes.set(xlabel=r"$|\gamma - \gamma_c|$")
    panels[0].set(ylabel=r"$|\lambda_1 - \lambda_2|\,t_0^2$")
    panels[0].legend(loc="lower right")
    if len(table):
        figure.suptitle(", ".join(labels.constants(table, ("phi", "kt"))))


def _panel(axes: Axes, rows: pd.DataFrame) -> None:
    axes.set(xscale="log", yscale="log")
    for n, colour, marker in appearance.curve_styles(sorted(rows["n"].unique())):
        style = {"color": colour, **THIN}
        for _, states in rows[rows["n"] == n].groupby(["seed", "point"]):
            axes.plot(states["distance"], states["difference"], marker + "-", **style)
        appearance.add_to_legend(axes, f"$N = {n:.0f}$", colour, marker)
    if len(rows):
        height = np.exp(np.median(np.log(rows["difference"] / np.sqrt(rows["distance"]))))
        axes.plot(LINE_ENDS, height * np.sqrt(LINE_ENDS), "k-", lw=1.2, label="slope 1/2")
