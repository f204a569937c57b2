"""psi^T and psi^R against omega, one panel per k_T (A, Fig. 8)."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import draw_panels
from grainmodes.figures.shared.selection import Options, panels, positive
from grainmodes.figures.shared.spectral_points import MODES, place

COLUMNS = spectral_rows.BINS | spectral_rows.FRACTION


def table(ensemble, options: Options) -> pd.DataFrame:
    """psi^T and psi^R in A's bins, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble has no k_T > 0.
        BlockError: the study computed no eigenvectors.
    """
    n, phi, found = place(options, points_with(ensemble, *MODES))
    kappas = panels(options.kt, positive(found, "participation"))
    points = [(n, phi, kappa) for kappa in kappas]
    return spectral_rows.rows(ensemble, options, points)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Squares: psi^T; circles: psi^R; a bin without modes has neither (A plots 0 there)."""
    filled = table[table["modes"] > 0]
    panels = draw_panels(figure, filled, r"$\psi^T,\ \psi^R$", _panel)
    for axes in panels:
        axes.set(ylim=(-0.05, 1.05), yticks=(0, 0.25, 0.5, 0.75, 1))
    panels[0].legend()


def _panel(axes: Axes, of: pd.DataFrame) -> None:
    for column, marker, colour, label in (
        ("psi_translational", "s", appearance.TRANSLATIONAL, r"$\psi^T$"),
        ("psi_rotational", "o", appearance.ROTATIONAL, r"$\psi^R$"),
    ):
        bars = of["psi_standard_error"]
        appearance.draw_cloud(axes, of["omega"], of[column], bars, colour, marker)
        appearance.add_to_legend(axes, label, colour, marker)
