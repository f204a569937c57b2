"""D(omega) of the Jacobian and of the effective Hessian, one panel per k_T (A, Fig. 12, App. H).

The Hessian with the tangent stiffnesses of the contact law is the Jacobian where every s = 0. With
the constants k_N and k_T printed in A (H2) it is so for harmonic contacts only.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import binned_spectrum, points_with, spectrum
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import draw_densities
from grainmodes.figures.shared.selection import Options, panels, positive
from grainmodes.figures.shared.spectral_points import ANY, place

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {"kind": ("-", "jacobian; hessian: tangent stiffnesses; printed: constants of A (H2)")}
)
HESSIANS = {"hessian": "_hessian", "printed": "_hessian_printed"}
STYLES = {
    "jacobian": {"label": "$J$", "colour": appearance.ROTATIONAL, "marker": "o"},
    "hessian": {
        "label": "$H$, tangent stiffnesses",
        "colour": appearance.TRANSLATIONAL,
        "marker": "s",
    }
    | appearance.OPEN,
    "printed": {"label": "$H$, as printed", "colour": "0.55", "marker": "^"},
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """D of all three in the same bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the study computed no Hessian.
        ValueError: the ensemble has no k_T > 0.
    """
    present = points_with(ensemble, "bin_count_hessian") & points_with(ensemble, *ANY)
    n, phi, found = place(options, present)
    kappas = panels(options.kt, positive(found, "dos_hessian"))
    return spectral_rows.stacked([_panel_rows(ensemble, (n, phi, kappa)) for kappa in kappas])[
        list(COLUMNS)
    ]


def _panel_rows(ensemble, point: spectral_rows.Point) -> pd.DataFrame:
    bins = {kind: binned_spectrum(ensemble, *point, ending) for kind, ending in HESSIANS.items()}
    bins["jacobian"] = spectrum(ensemble, *point).in_bins(bins["hessian"].edges)
    return spectral_rows.stacked(
        [spectral_rows.of_bins(of, point, kind) for kind, of in bins.items()]
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol."""
    draw_densities(figure, table, _panel)[0].legend()


def _panel(axes: Axes, of: pd.DataFrame) -> None:
    appearance.draw_kinds(axes, of, "density", STYLES)
