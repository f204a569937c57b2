"""The participation ratio p(omega), one panel per k_T (A, Fig. 14).

With rattlers kept where the study has such spectra, as in A: a mode of one grain has p = 1/N, the
line of the figure.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import draw_panels
from grainmodes.figures.shared.selection import PAPER_RATTLERS, Options, panels, positive
from grainmodes.figures.shared.spectral_points import place

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.PARTICIPATION
    | {"kind": ("-", "with rattlers kept, or without them")}
)
ENDINGS = {"with": "_rattlers", "without": ""}
NAMES = ("participation_ratio", "bin_participation_ratio")


def table(ensemble, options: Options) -> pd.DataFrame:
    """p in A's bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the study computed no eigenvectors.
        ValueError: the ensemble has no k_T > 0.
    """
    kind = "with" if f"{NAMES[0]}{ENDINGS['with']}" in ensemble else "without"
    ending = ENDINGS[kind]
    n, phi, found = place(options, points_with(ensemble, *(name + ending for name in NAMES)))
    kappas = panels(options.kt, positive(found, "participation_ratio"), PAPER_RATTLERS)
    kinds = [{kind: ((n, phi, kappa), ending)} for kappa in kappas]
    parts = [spectral_rows.compared(ensemble, options, of) for of in kinds]
    return spectral_rows.stacked(parts)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol (A plots 0 there)."""
    filled = table[table["participation_ratio"].notna()]
    panels = draw_panels(
        figure, filled, r"$p(\omega)$", _panel, f"{table['kind'].iloc[0]} rattlers"
    )
    for axes in panels:
        axes.set_yscale("log")
    panels[0].legend()


def _panel(axes: Axes, of: pd.DataFrame) -> None:
    axes.axhline(1.0 / of["n"].iloc[0], color="0.4", linestyle="--", linewidth=0.7, label="$1/N$")
    bars = of["participation_ratio_standard_error"]
    appearance.draw_cloud(
        axes, of["omega"], of["participation_ratio"], bars, appearance.ROTATIONAL, "o"
    )
