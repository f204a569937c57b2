"""D(omega) for several phi at one small k_T, towards jamming (A, Fig. 16)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import draw_curves
from grainmodes.figures.shared.selection import Options, curves
from grainmodes.figures.shared.spectral_points import line, weakly_frictional

COLUMNS = spectral_rows.BINS | spectral_rows.DENSITY


def table(ensemble, options: Options) -> pd.DataFrame:
    """D in A's bins for every phi of the N with most phi, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble has no k_T > 0.
    """
    present, kappa = weakly_frictional(ensemble, options, "dos_phi")
    n, phis = line("n", options.n, present)
    asked = None if options.phi is None else (options.phi,)
    points = [(n, phi, kappa) for phi in curves(asked, phis, "phi")]
    return spectral_rows.rows(ensemble, options, points)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol."""
    axes = draw_curves(figure, table, "phi", appearance.fraction)
    axes.legend(title=r"$\phi$")
    appearance.write_caption(figure, table, ("n", "kt"))
