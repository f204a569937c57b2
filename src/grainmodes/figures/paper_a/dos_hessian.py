"""The density of states of the Jacobian and of the effective Hessian: A, Fig. 12 and App. H.

One panel per k_T. The Hessian with the tangent stiffnesses of the contact law equals the Jacobian
where every s = 0. The Hessian with the constants k_N and k_T printed in A (H2) equals it for
harmonic contacts only.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import binned_spectrum, points_with, spectrum
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.selection import Options, choose_panels, positive_kts
from grainmodes.figures.shared.spectral_panels import draw_density_kinds
from grainmodes.figures.shared.spectral_points import (
    SPECTRUM_VARIABLES,
    Coordinates,
    choose_points,
)

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {"kind": ("-", "jacobian; hessian: tangent stiffnesses; printed: constants of A (H2)")}
)
HESSIANS = {"hessian": "_hessian", "printed": "_hessian_printed"}
"""Kind → ending of the names in the ensemble."""

STYLES = {
    "jacobian": {"label": "$J$", "colour": appearance.ROTATIONAL, "marker": "o"},
    "hessian": {
        "label": "$H$, tangent stiffnesses",
        "colour": appearance.TRANSLATIONAL,
        "marker": "s",
    }
    | appearance.OPEN_SYMBOLS,
    "printed": {"label": "$H$, as printed", "colour": "0.55", "marker": "^"},
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """D of all three in the same bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the study computed no Hessian.
        ValueError: the ensemble has no k_T > 0, or no spectra at the requested n, phi or kt.
    """
    present = points_with(ensemble, "bin_count_hessian")
    present &= points_with(ensemble, *SPECTRUM_VARIABLES)
    chosen = choose_points(options, present)
    kts = choose_panels(options.kt, positive_kts(chosen.kt, "dos_hessian"))
    parts = [_rows_at(ensemble, point) for point in chosen.at(kts)]
    return spectral_rows.stack(parts)[list(COLUMNS)]


def _rows_at(ensemble, point: Coordinates) -> pd.DataFrame:
    bins = {kind: binned_spectrum(ensemble, *point, ending) for kind, ending in HESSIANS.items()}
    bins["jacobian"] = spectrum(ensemble, *point).in_bins(bins["hessian"].edges)
    return spectral_rows.stack(
        [spectral_rows.rows_of_bins(modes, point, kind) for kind, modes in bins.items()]
    )


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Density of states of the Jacobian (blue filled circles) and of the effective Hessian of "
        "A's Appendix H, in the same bins, a panel per k_T/k_N: red open squares with the tangent "
        "stiffnesses of the contact law, grey triangles with the constants k_N and k_T that A "
        "(H2) prints. Double logarithmic; bars: standard errors over the samples, as long below "
        "as above.",
        "whether squares surround circles everywhere, and how far the triangles lie from both.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a panel per k_T, double logarithmic."""
    draw_density_kinds(figure, table, STYLES)
