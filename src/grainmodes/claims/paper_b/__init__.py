"""The claims B1 to B10 of paper B (Ishima, Saitoh, Otsuki, Hayakawa), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_b import events, methods, theory

CLAIMS: tuple[Claim, ...] = (
    theory.theory_is_simulation,
    methods.independent_of_min_step,
    events.jump_without_precursor,
    events.no_singularity,
    methods.critical_strain_converges,
    methods.symmetric_jacobian,
    events.quadrupole_of_rotations,
    theory.mean_rigidity,
    events.contacts_at_events,
    theory.rigidity_before_strain,
)
"""B1 to B10, in this order."""
