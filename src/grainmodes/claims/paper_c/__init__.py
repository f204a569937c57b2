"""The claims of paper C (Chattoraj, Gendelman, Pica Ciamarra, Procaccia), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_c import variants

CLAIMS: tuple[Claim, ...] = (
    variants.smoothed_is_unstable,
    variants.sharp_is_stable,
)
"""C8 and C9, in this order."""
