"""What the ensembles show and none of the papers says: G1 to G4, each with its figure."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.own import memory, rigidity

CLAIMS: tuple[Claim, ...] = (
    rigidity.sign_change_falls_with_density,
    rigidity.loaded_step_only_softens,
    memory.memory_of_springs_decides,
    rigidity.exponent_of_strong_friction,
)
"""G1 to G4, in this order."""
