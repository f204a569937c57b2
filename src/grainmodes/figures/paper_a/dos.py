"""The density of states D(ω), A (23), one panel per k_T: A, Fig. 9.

Double logarithmic. Symbols are means over the samples, bars their standard errors.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.mode_marks import draw_marks
from grainmodes.figures.shared.selection import Options, choose_panels
from grainmodes.figures.shared.spectral_panels import draw_density_panels
from grainmodes.figures.shared.spectral_points import choose_density_points

COLUMNS = spectral_rows.BINS | spectral_rows.DENSITY


def table(ensemble, options: Options) -> pd.DataFrame:
    """D in A's bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: it holds none at the requested n, phi or kt.
    """
    chosen = choose_density_points(ensemble, options)
    points = chosen.at(choose_panels(options.kt, chosen.kt))
    return spectral_rows.bin_rows(ensemble, options, points)[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Density of states D(ω), A (23), against ω t_0, double logarithmic, a panel per k_T/k_N. "
        "Symbols: means over the samples, bars: standard errors over the samples, as long below "
        "as above. Dotted lines (a1), …, (b3): the frequencies near which the figure of "
        "eigenvectors shows a mode (A, Fig. 7).",
        "the rotational band, which moves as ω_R t_0 = (k_T/k_N)^(1/2), and its distance to the "
        "translational band, which does not depend on k_T at weak friction.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a panel per k_T, with marks at the modes of A's Fig. 7."""
    for axes, kt in draw_density_panels(figure, table, _panel).items():
        draw_marks(axes, kt)


def _panel(axes: Axes, bins: pd.DataFrame) -> None:
    bars = appearance.logarithmic_bars(bins["density"], bins["density_standard_error"])
    appearance.draw_cloud(axes, bins["omega"], bins["density"], bars, appearance.ROTATIONAL, "o")
