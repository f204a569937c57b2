"""D(omega), one panel per k_T (A, Fig. 9)."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import draw_densities
from grainmodes.figures.shared.selection import Options, panels
from grainmodes.figures.shared.spectral_points import place_of_densities

COLUMNS = spectral_rows.BINS | spectral_rows.DENSITY


def table(ensemble, options: Options) -> pd.DataFrame:
    """D in A's bins, with the columns `COLUMNS`."""
    n, phi, kappas = place_of_densities(ensemble, options)
    points = [(n, phi, kappa) for kappa in panels(options.kt, kappas)]
    return spectral_rows.rows(ensemble, options, points)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol."""
    draw_densities(figure, table, _panel)


def _panel(axes: Axes, of: pd.DataFrame) -> None:
    bars = of["density_standard_error"]
    appearance.draw_cloud(axes, of["omega"], of["density"], bars, appearance.ROTATIONAL, "o")
