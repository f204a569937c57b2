"""The spectra in which paper A shows its bands: those of every k_T > 0 at one N and φ.

A shows them at φ = 0.90, its largest φ. Here it is the largest φ of the ensemble.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grainmodes.claims.bands import SEPARABLE, Modes, modes, separable
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled

if TYPE_CHECKING:
    import xarray as xr

REGION_BOUNDARY = 2.0
"""omega / omega_R at the boundary between Regions I and II."""


def friction_spectra(ensemble: xr.Dataset) -> tuple[Samples, float, dict[float, Modes]]:
    """The samples of the N with most spectra, its largest φ, and k_T/k_N > 0 → modes there."""
    samples = best_sampled(separable(ensemble), SEPARABLE)
    phi = samples.phis(SEPARABLE)[-1]
    kappas = samples.kappas(SEPARABLE, phi, ABOVE_ZERO)
    return samples, phi, {kappa: modes(samples, phi, kappa) for kappa in kappas}


def within(by_kappa: dict, low: float, high: float) -> dict:
    """The entries of k_T/k_N → value with k_T/k_N in [low, high]."""
    return {k: value for k, value in by_kappa.items() if low * 0.999 <= k <= high * 1.001}
