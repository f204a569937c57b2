"""The claims of paper C (Chattoraj, Gendelman, Pica Ciamarra, Procaccia), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_c import release

CLAIMS: tuple[Claim, ...] = (
    release.spirals,
    release.growth,
    release.second_instability,
    release.damping,
)
"""C4 to C7, in this order."""
