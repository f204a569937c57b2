"""The density of states with and without rattlers, one panel per k_T: A, Fig. 13.

Both in the same bins. Filled triangles: without rattlers; open circles: with rattlers, each of
which adds modes near zero.
"""

from __future__ import annotations

import pandas as pd
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
from grainmodes.figures.shared.spectral_panels import draw_density_kinds
from grainmodes.figures.shared.spectral_points import choose_points

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {"kind": ("-", "with rattlers kept, or without them, in the same bins")}
)
STYLES = {
    "without": {"label": "without rattlers", "colour": appearance.ROTATIONAL, "marker": "^"},
    "with": {"label": "with rattlers", "colour": appearance.TRANSLATIONAL, "marker": "o"}
    | appearance.OPEN_SYMBOLS,
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """D of both in the same bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the study kept no rattlers.
        ValueError: the ensemble has no k_T > 0, or no spectra at the requested n, phi or kt.
    """
    chosen = choose_points(options, points_with(ensemble, "eigenvalue_rattlers"))
    kts = choose_panels(options.kt, positive_kts(chosen.kt, "dos_rattlers"), PAPER_RATTLER_KTS)
    parts = []
    for point in chosen.at(kts):
        kinds = {"with": (point, "_rattlers"), "without": (point, "")}
        parts.append(spectral_rows.compare_spectra(ensemble, options, kinds))
    return spectral_rows.stack(parts)[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Density of states without rattlers (blue filled triangles) and with them (red open "
        "circles), in the same bins, a panel per k_T/k_N. A rattler has at most Z_Th contacts; "
        "rattlers are removed until none is left. Double logarithmic; bars: standard errors over "
        "the samples, as long below as above.",
        "which modes only the spectrum with rattlers has, and whether modes between the bands "
        "remain without them.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a panel per k_T, double logarithmic."""
    draw_density_kinds(figure, table, STYLES)
