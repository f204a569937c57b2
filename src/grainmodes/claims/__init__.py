"""The claims A1 to A19 of paper A, each a check on an ensemble: `check` → a `Verdict` of each."""

from __future__ import annotations

from grainmodes.claims import band_claims, method_claims, rigidity_claims, spectrum_claims
from grainmodes.claims.claim import Claim, Verdict

CLAIMS: tuple[Claim, ...] = (
    rigidity_claims.theory_is_simulation,
    rigidity_claims.not_proportional_to_distance,
    rigidity_claims.flat_at_small_stiffness,
    rigidity_claims.frictionless_limit,
    rigidity_claims.no_factorisation,
    rigidity_claims.nonaffine_sign_change,
    band_claims.pure_regions,
    band_claims.gap_overlap_merger,
    band_claims.peak_and_collapse,
    band_claims.area_of_rotational_band,
    band_claims.frictionless_band,
    method_claims.hessian_density,
    spectrum_claims.localised_rattlers,
    spectrum_claims.independent_of_size,
    spectrum_claims.towards_jamming,
    rigidity_claims.independent_of_strain,
    rigidity_claims.translational_modes_suffice,
    method_claims.verlet_orders,
    method_claims.complex_pairs_with_friction,
)
"""A1 to A19, in this order."""


def check(ensemble) -> list[Verdict]:
    """The verdict on every claim, A1 to A19.

    Args:
        ensemble: dataset of `grainmodes.ensemble.open_ensemble`; claims whose observables or
            points it lacks are "not asked".
    """
    return [claim(ensemble) for claim in CLAIMS]
