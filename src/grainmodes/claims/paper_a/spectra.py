"""The spectra on which paper A shows its bands: of every k_T > 0, at one N and φ.

A's is φ = 0.90, its largest; here it is the largest φ of the ensemble.
"""

from __future__ import annotations

from grainmodes.claims.bands import SEPARABLE, Modes, modes, separable
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled

REGION_BOUNDARY = 2.0
"""omega / omega_R between Regions I and II."""


def friction_spectra(ensemble) -> tuple[Samples, float, dict[float, Modes]]:
    """The N with most spectra, its largest φ, and the modes of every k_T > 0 there."""
    samples = best_sampled(separable(ensemble), SEPARABLE)
    phi = samples.phis(SEPARABLE)[-1]
    kappas = samples.kappas(SEPARABLE, phi, ABOVE_ZERO)
    return samples, phi, {kappa: modes(samples, phi, kappa) for kappa in kappas}


def within(of_kappa: dict, low: float, high: float) -> dict:
    """What belongs to a k_T/k_N in [low, high]."""
    return {kappa: of for kappa, of in of_kappa.items() if low * 0.999 <= kappa <= high * 1.001}
