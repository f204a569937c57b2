"""D(omega) with and without rattlers, one panel per k_T (A, Fig. 13)."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import draw_densities
from grainmodes.figures.shared.selection import PAPER_RATTLERS, Options, panels, positive
from grainmodes.figures.shared.spectral_points import place

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {"kind": ("-", "with rattlers kept, or without them, in the same bins")}
)
STYLES = {
    "without": {"label": "without rattlers", "colour": appearance.ROTATIONAL, "marker": "^"},
    "with": {"label": "with rattlers", "colour": appearance.TRANSLATIONAL, "marker": "o"}
    | appearance.OPEN,
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """D of both in the same bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the study kept no rattlers.
        ValueError: the ensemble has no k_T > 0.
    """
    n, phi, found = place(options, points_with(ensemble, "eigenvalue_rattlers"))
    parts = []
    for kappa in panels(options.kt, positive(found, "dos_rattlers"), PAPER_RATTLERS):
        point = (n, phi, kappa)
        kinds = {"with": (point, "_rattlers"), "without": (point, "")}
        parts.append(spectral_rows.compared(ensemble, options, kinds))
    return spectral_rows.stacked(parts)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol."""
    draw_densities(figure, table, _panel)[0].legend()


def _panel(axes: Axes, of: pd.DataFrame) -> None:
    appearance.draw_kinds(axes, of, "density", STYLES)
