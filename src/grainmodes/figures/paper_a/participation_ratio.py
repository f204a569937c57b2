"""The participation ratio p(ω) of the modes, A (E2), one panel per k_T: A, Fig. 14.

Double logarithmic, with standard errors. Rattlers are kept, as in A, where the study has such
spectra: a mode of one grain has p = 1/N, the dashed line. A bin without modes has no symbol, where
A plots 0.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.selection import (
    PAPER_RATTLER_KTS,
    Options,
    choose_panels,
    positive_kts,
)
from grainmodes.figures.shared.spectral_panels import draw_panels
from grainmodes.figures.shared.spectral_points import choose_points

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.PARTICIPATION
    | {"kind": ("-", "with rattlers kept, or without them")}
)
ENDINGS = {"with": "_rattlers", "without": ""}
VARIABLES = ("participation_ratio", "bin_participation_ratio")


def table(ensemble, options: Options) -> pd.DataFrame:
    """p in A's bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the study computed no eigenvectors.
        ValueError: the ensemble has no k_T > 0, or no modes at the requested n, phi or kt.
    """
    kind = "with" if f"{VARIABLES[0]}{ENDINGS['with']}" in ensemble else "without"
    ending = ENDINGS[kind]
    present = points_with(ensemble, *(name + ending for name in VARIABLES))
    chosen = choose_points(options, present)
    kts = positive_kts(chosen.kt, "participation_ratio")
    parts = [
        spectral_rows.compare_spectra(ensemble, options, {kind: (point, ending)})
        for point in chosen.at(choose_panels(options.kt, kts, PAPER_RATTLER_KTS))
    ]
    return spectral_rows.stack(parts)[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        f"Participation ratio p(ω) of the modes, A (E2), {table['kind'].iloc[0]} rattlers, against "
        "ω t_0, double logarithmic, a panel per k_T/k_N. Means over the modes of a bin; bars: "
        "standard errors over the samples, as long below as above. Dashed line: 1/N, a mode of a "
        "single grain. A bin without modes has no symbol, where A plots 0.",
        "modes near the dashed line, below and between the bands, which are localised; the "
        "rotational band, which moves with (k_T/k_N)^(1/2) and keeps its shape.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a panel per k_T."""
    filled = table[table["participation_ratio"].notna()]
    note = f"{table['kind'].iloc[0]} rattlers"
    panels = draw_panels(figure, filled, r"$p(\omega)$", _panel, note)
    for axes in panels:
        axes.set_yscale("log")
    next(iter(panels)).legend()


def _panel(axes: Axes, bins: pd.DataFrame) -> None:
    one_grain = 1.0 / bins["n"].iloc[0]
    axes.axhline(one_grain, color="0.4", linestyle="--", linewidth=0.7, label="$1/N$")
    ratio = bins["participation_ratio"]
    bars = appearance.logarithmic_bars(ratio, bins["participation_ratio_standard_error"])
    appearance.draw_cloud(axes, bins["omega"], ratio, bars, appearance.ROTATIONAL, "o")
