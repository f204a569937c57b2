"""The claims of paper C (Chattoraj, Gendelman, Pica Ciamarra, Procaccia), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_c import laws, pairs, release

CLAIMS: tuple[Claim, ...] = (
    pairs.born_under_shear,
    pairs.square_root,
    pairs.parallel_eigenvectors,
    release.spirals,
    release.growth,
    release.second_instability,
    release.damping,
    laws.smoothed_is_unstable,
    laws.sharp_is_stable,
)
"""C1 to C9, in this order."""
