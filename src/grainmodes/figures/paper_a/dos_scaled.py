"""The density of states scaled by ω_R t_0 = (k_T / k_N)^(1/2): A, Fig. 10.

ω_R D against ω / ω_R, double logarithmic, a colour per k_T; small k_T lie on top.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, labels, spectral_rows
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.selection import Options, choose_curves, positive_kts
from grainmodes.figures.shared.spectral_points import choose_density_points

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {
        "scaled_omega": ("1", "omega / omega_R"),
        "scaled_density": ("1", "omega_R D"),
        "scaled_density_standard_error": ("1", "standard error of omega_R D"),
    }
)
SCALED_RANGE = (0.1, 10.0)
"""Range of omega / omega_R of A, Fig. 10."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """The scaled density of states within `SCALED_RANGE`, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: it has no k_T > 0, or no spectra at the requested n, phi or kt.
    """
    chosen = choose_density_points(ensemble, options)
    kts = choose_curves(options.kt, positive_kts(chosen.kt, "dos_scaled"), "kt")
    rows = spectral_rows.bin_rows(ensemble, options, chosen.at(kts))
    omega_r = np.sqrt(rows["kt"])
    rows["scaled_omega"] = rows["omega"] / omega_r
    rows["scaled_density"] = rows["density"] * omega_r
    rows["scaled_density_standard_error"] = rows["density_standard_error"] * omega_r
    return rows[rows["scaled_omega"].between(*SCALED_RANGE)][list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Density of states scaled by ω_R = (k_T/k_N)^(1/2)/t_0: ω_R D against ω/ω_R, double "
        "logarithmic, a colour per k_T/k_N; small k_T lie on top. Bars: standard errors over the "
        "samples, as long below as above.",
        "whether the curves of k_T/k_N ≤ 10⁻² coincide for 0.1 < ω/ω_R < 1, and where the peak "
        "lies.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw all curves in one panel."""
    axes = figure.subplots()
    filled = table[table["modes"] > 0]
    for kt, colour, marker in appearance.curve_styles(sorted(filled["kt"].unique())):
        bins = filled[filled["kt"] == kt]
        omega, density = bins["scaled_omega"], bins["scaled_density"]
        bars = appearance.logarithmic_bars(density, bins["scaled_density_standard_error"])
        appearance.draw_cloud(axes, omega, density, bars, colour, marker, zorder=3 - kt / 100)
        appearance.add_to_legend(axes, f"${labels.ratio(kt)}$", colour, marker)
    limits = appearance.logarithmic_limits(filled["scaled_density"])
    axes.set(xscale="log", yscale="log", xlim=SCALED_RANGE, ylim=limits)
    axes.set(xlabel=r"$\omega / \omega_R$", ylabel=r"$\omega_R D(\omega / \omega_R)$")
    axes.legend(title="$k_T / k_N$", ncols=2)
    labels.write_caption(figure, table, ("n", "phi"))
