"""The claims of paper C (Chattoraj, Gendelman, Pica Ciamarra, Procaccia), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_c import aftermath, damping, growth, laws, pairs

CLAIMS: tuple[Claim, ...] = (
    pairs.born_under_shear,
    pairs.square_root,
    pairs.parallel_eigenvectors,
    growth.spirals,
    growth.growth,
    aftermath.second_instability,
    damping.damping,
    laws.smoothed_is_unstable,
    laws.sharp_is_stable,
    growth.end_of_growth,
    growth.death_of_the_pair,
    growth.fastest_dominates,
    aftermath.diffusive,
    aftermath.longer_tail,
    aftermath.pressure_at_every_z,
    aftermath.contacts_at_the_threshold,
)
"""C1 to C16, in this order."""
