"""The claims A1 to A22 of paper A (Ishima, Saitoh, Otsuki, Hayakawa), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_a import (
    density,
    methods,
    nonaffine,
    rigidity,
    rotational_band,
    theory,
    two_bands,
)

CLAIMS: tuple[Claim, ...] = (
    theory.theory_is_simulation,
    rigidity.not_proportional_to_distance,
    rigidity.flat_at_small_stiffness,
    rigidity.frictionless_limit,
    rigidity.no_factorisation,
    nonaffine.nonaffine_sign_change,
    two_bands.pure_regions,
    two_bands.gap_overlap_merger,
    rotational_band.peak_and_collapse,
    rotational_band.area_of_rotational_band,
    two_bands.frictionless_band,
    methods.hessian_density,
    density.localised_rattlers,
    density.independent_of_size,
    density.towards_jamming,
    theory.independent_of_strain,
    theory.translational_modes_suffice,
    methods.verlet_orders,
    methods.complex_pairs_with_friction,
    two_bands.translational_band_is_fixed,
    theory.fields_agree,
    rotational_band.shape_of_participation,
)
"""A1 to A22, in this order."""
