"""Translational and rotational fractions ψ^T and ψ^R of the modes, A (51) and (52): A, Fig. 8.

One panel per k_T, against ω. Squares: ψ^T; circles: ψ^R, with standard errors. A bin without modes
has neither, where A plots 0.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.mode_marks import draw_marks
from grainmodes.figures.shared.selection import Options, choose_panels, positive_kts
from grainmodes.figures.shared.spectral_panels import draw_panels
from grainmodes.figures.shared.spectral_points import MODE_VARIABLES, choose_points

COLUMNS = spectral_rows.BINS | spectral_rows.FRACTION


def table(ensemble, options: Options) -> pd.DataFrame:
    """ψ^T and ψ^R in A's bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the study computed no eigenvectors.
        ValueError: the ensemble has no k_T > 0, or no modes at the requested n, phi or kt.
    """
    chosen = choose_points(options, points_with(ensemble, *MODE_VARIABLES))
    kts = choose_panels(options.kt, positive_kts(chosen.kt, "participation"))
    return spectral_rows.bin_rows(ensemble, options, chosen.at(kts))[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Translational fraction ψᵀ (red squares) and rotational fraction ψᴿ (blue circles) of the "
        "modes, A (51) and (52), against ω t_0, a panel per k_T/k_N. Means over the modes of a "
        "bin; bars: standard errors over the samples. A bin without modes has no symbol, where A "
        "plots 0. Dotted lines (a1), …, (b3): the frequencies near which the figure of "
        "eigenvectors shows a mode (A, Fig. 7).",
        "Region I, where ψᴿ is 1, below Region II, where ψᵀ is 1; the gap between them at weak "
        "friction, and how both fractions mix in all modes once k_T is of the order of k_N.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a panel per k_T, with marks at the modes of A's Fig. 7."""
    filled = table[table["modes"] > 0]
    panels = draw_panels(figure, filled, r"$\psi^T,\ \psi^R$", _panel)
    for axes, kt in panels.items():
        axes.set(ylim=(-0.05, 1.05), yticks=(0, 0.25, 0.5, 0.75, 1))
        draw_marks(axes, kt)
    next(iter(panels)).legend()


def _panel(axes: Axes, bins: pd.DataFrame) -> None:
    for column, marker, colour, label in (
        ("psi_translational", "s", appearance.TRANSLATIONAL, r"$\psi^T$"),
        ("psi_rotational", "o", appearance.ROTATIONAL, r"$\psi^R$"),
    ):
        bars = bins["psi_standard_error"]
        appearance.draw_cloud(axes, bins["omega"], bins[column], bars, colour, marker)
        appearance.add_to_legend(axes, label, colour, marker)
