"""D(omega) for several N at one small k_T (A, Fig. 15)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import draw_curves
from grainmodes.figures.shared.selection import Options, curves
from grainmodes.figures.shared.spectral_points import line, weakly_frictional

COLUMNS = spectral_rows.BINS | spectral_rows.DENSITY


def table(ensemble, options: Options) -> pd.DataFrame:
    """D in A's bins for every N at the φ with most N, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble has no k_T > 0.
    """
    present, kappa = weakly_frictional(ensemble, options, "dos_n")
    phi, ns = line("phi", options.phi, present)
    asked = None if options.n is None else (options.n,)
    points = [(n, phi, kappa) for n in curves(asked, ns, "n")]
    return spectral_rows.rows(ensemble, options, points)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol."""
    axes = draw_curves(figure, table, "n", "{:.0f}".format)
    axes.legend(title="$N$")
    appearance.write_caption(figure, table, ("phi", "kt"))
