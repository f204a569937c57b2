"""The density of states for several N at one small k_T: A, Fig. 15.

Double logarithmic, a colour per N; the φ is the one at which most N have spectra.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.figures.shared import labels, spectral_rows
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.spectral_panels import draw_density_curves
from grainmodes.figures.shared.spectral_points import weak_points_along

COLUMNS = spectral_rows.BINS | spectral_rows.DENSITY


def table(ensemble, options: Options) -> pd.DataFrame:
    """D in A's bins for every N at one φ, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: it holds none with k_T > 0, or none at the requested n, phi or kt.
    """
    points = weak_points_along("n", ensemble, options, "dos_n")
    return spectral_rows.bin_rows(ensemble, options, points)[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Density of states D(ω) at one weak k_T/k_N, a colour per number of grains N. Double "
        "logarithmic; bars: standard errors over the samples, as long below as above; the number "
        "of samples may differ from N to N. A line ends where a bin has no modes.",
        "whether the curves coincide in both bands; a larger box adds sound waves at the low end "
        "of the translational band.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a curve per N."""
    axes = draw_density_curves(figure, table, "n", "{:.0f}".format)
    axes.legend(title="$N$")
    labels.write_caption(figure, table, ("phi", "kt"))
