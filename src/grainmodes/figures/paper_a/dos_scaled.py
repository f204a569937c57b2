"""omega_R D against omega / omega_R, omega_R t_0 = (k_T / k_N)^(1/2) (A, Fig. 10)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.selection import Options, curves, positive
from grainmodes.figures.shared.spectral_points import place_of_densities

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {
        "scaled_omega": ("1", "omega / omega_R"),
        "scaled_density": ("1", "omega_R D"),
        "scaled_density_standard_error": ("1", "standard error of omega_R D"),
    }
)
SHOWN = (0.1, 10.0)
"""Range of omega / omega_R of A, Fig. 10."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """The scaled density of states within `SHOWN`, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble has no k_T > 0.
    """
    n, phi, present = place_of_densities(ensemble, options)
    kappas = curves(options.kt, positive(present, "dos_scaled"), "kt")
    found = spectral_rows.rows(ensemble, options, [(n, phi, kappa) for kappa in kappas])
    rotational = np.sqrt(found["kt"])
    found["scaled_omega"] = found["omega"] / rotational
    found["scaled_density"] = found["density"] * rotational
    found["scaled_density_standard_error"] = found["density_standard_error"] * rotational
    return found[found["scaled_omega"].between(*SHOWN)][list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol; small k_T lie on top."""
    axes = figure.subplots()
    filled = table[table["modes"] > 0]
    for kappa, colour, marker in appearance.series(sorted(filled["kt"].unique())):
        of = filled[filled["kt"] == kappa]
        curve = (of[f"scaled_{name}"] for name in ("omega", "density", "density_standard_error"))
        appearance.draw_cloud(axes, *curve, colour, marker, zorder=3 - kappa / 100)
        appearance.add_to_legend(axes, f"${appearance.power(kappa)}$", colour, marker)
    limits = appearance.logarithmic_limits(filled["scaled_density"])
    axes.set(xscale="log", yscale="log", xlim=SHOWN, ylim=limits)
    axes.set(xlabel=r"$\omega / \omega_R$", ylabel=r"$\omega_R D(\omega / \omega_R)$")
    axes.legend(title="$k_T / k_N$", ncols=2)
    appearance.write_caption(figure, table, ("n", "phi"))
