"""The claims B1 to B14 of paper B (Ishima, Saitoh, Otsuki, Hayakawa), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_b import before_events, events, methods, theory

CLAIMS: tuple[Claim, ...] = (
    theory.theory_is_simulation,
    methods.independent_of_min_step,
    before_events.jump_without_precursor,
    before_events.no_singularity,
    methods.critical_strain_converges,
    methods.tangential_integral,
    events.quadrupole_of_rotations,
    theory.mean_rigidity,
    events.contacts_at_events,
    theory.rigidity_before_strain,
    methods.symmetric_jacobian,
    methods.rate_after_event,
    methods.springs_without_history,
    events.jumps_grow_with_strain,
)
"""B1 to B14, in this order."""
