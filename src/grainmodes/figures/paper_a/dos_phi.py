"""The density of states for several φ at one small k_T, towards jamming: A, Fig. 16.

Double logarithmic, a colour per φ; the N is the one of which most φ have spectra.
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
    """D in A's bins for every φ of one N, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: it holds none with k_T > 0, or none at the requested n, phi or kt.
    """
    points = weak_points_along("phi", ensemble, options, "dos_phi")
    return spectral_rows.bin_rows(ensemble, options, points)[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Density of states D(ω) at one weak k_T/k_N, a colour per area fraction φ. Double "
        "logarithmic; bars: standard errors over the samples, as long below as above. A line ends "
        "where a bin has no modes.",
        "towards jamming the rotational band moves to lower ω, and the plateau of the "
        "translational band becomes longer.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a curve per φ."""
    axes = draw_density_curves(figure, table, "phi", labels.fraction)
    axes.legend(title=r"$\phi$")
    labels.write_caption(figure, table, ("n", "kt"))
