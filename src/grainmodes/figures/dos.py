"""D(omega), one panel per k_T (A, Fig. 9)."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures import appearance, spectral_rows
from grainmodes.figures.panels import draw_panels
from grainmodes.figures.selection import Options, panels

COLUMNS = spectral_rows.BINS | spectral_rows.DENSITY


def table(ensemble, options: Options) -> pd.DataFrame:
    """D in A's bins, with the columns `COLUMNS`."""
    kappas = panels(options.kt, ensemble["kt"].to_numpy())
    return spectral_rows.rows(ensemble, options, kappas)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol."""
    filled = table[table["modes"] > 0]
    panels = draw_panels(figure, filled, r"$D(\omega) / t_0$", _panel)
    panels[0].set(yscale="log", ylim=appearance.logarithmic_limits(filled["density"]))


def _panel(axes: Axes, of: pd.DataFrame) -> None:
    bars = of["density_standard_error"]
    appearance.draw_cloud(axes, of["omega"], of["density"], bars, appearance.ROTATIONAL, "o")
