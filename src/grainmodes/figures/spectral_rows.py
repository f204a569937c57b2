"""Rows of the figures of the spectrum: one per bin of A's binning, for each k_T.

Zero and negative modes have no place on the axis of omega; their mean number per sample stands in
every row, so that bins + zero + negative modes are all modes.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from grainmodes import binning, statistics
from grainmodes.ensemble.averages import Spectrum, area_fractions_with_spectra, spectrum
from grainmodes.figures.selection import Options, largest_or

BINS = {
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("k_N", "tangential stiffness k_T"),
    "omega": ("1/t_0", "geometric middle of the bin"),
    "omega_low": ("1/t_0", "lower edge of the bin"),
    "omega_high": ("1/t_0", "upper edge of the bin"),
    "samples": ("1", "number of converged samples"),
    "modes": ("1", "modes in the bin, all samples together"),
    "zero_modes": ("1", "zero modes left out, mean per sample"),
    "negative_modes": ("1", "negative modes left out, mean per sample"),
}
DENSITY = {
    "density": ("t_0", "density of states D, A Eq. 23; unjammed samples count as 0"),
    "density_standard_error": ("t_0", "standard error of D over samples"),
}
FRACTION = {
    "psi_translational": ("1", "psi^T, A Eq. 51; no value in an empty bin"),
    "psi_rotational": ("1", "psi^R, A Eq. 52; no value in an empty bin"),
    "psi_standard_error": ("1", "standard error of both, over samples"),
}


def rows(ensemble, options: Options, kappas: list[float]) -> pd.DataFrame:
    """The bins of several k_T below each other, with all columns of this module.

    A k_T without any vibration (no jammed sample) has no rows.
    """
    n = largest_or(options.n, ensemble["n"].to_numpy(), "n")
    phi = largest_or(options.phi, area_fractions_with_spectra(ensemble, n), "phi")
    parts = []
    for kappa in kappas:
        found = _bins(spectrum(ensemble, n, phi, kappa), n, kappa, options.fineness)
        parts.append(found.assign(n=n, phi=phi, kt=kappa))
    return pd.concat(parts, ignore_index=True)[[*BINS, *DENSITY, *FRACTION]]


def _bins(modes: Spectrum, n: int, kappa: float, fineness: float) -> pd.DataFrame:
    found = statistics.frequencies(modes.eigenvalue)
    if not np.isfinite(found.frequency).any():
        return pd.DataFrame(columns=[*BINS, *DENSITY, *FRACTION])
    lowest, highest = np.nanmin(found.frequency), np.nanmax(found.frequency)
    edges = binning.bin_edges(kappa, lowest, highest, fineness)
    density = statistics.density_of_states(found.frequency, n, edges)
    psi = statistics.mode_average(modes.psi_rotational, found.frequency, edges)
    return pd.DataFrame(
        {
            "omega": binning.bin_centres(edges),
            "omega_low": edges[:-1],
            "omega_high": edges[1:],
            "samples": density.samples,
            "modes": binning.occupation(found.frequency, edges).sum(axis=0).astype(int),
            "zero_modes": found.zero.mean(),
            "negative_modes": found.negative.mean(),
            "density": density.mean,
            "density_standard_error": density.standard_error,
            "psi_translational": 1.0 - psi.mean,
            "psi_rotational": psi.mean,
            "psi_standard_error": psi.standard_error,
        }
    )
