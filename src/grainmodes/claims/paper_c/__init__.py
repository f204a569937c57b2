"""The claims of paper C (Chattoraj, Gendelman, Pica Ciamarra, Procaccia), a module per theme."""

from __future__ import annotations

from grainmodes.claims.claim import Claim
from grainmodes.claims.paper_c import pairs

CLAIMS: tuple[Claim, ...] = (
    pairs.born_under_shear,
    pairs.square_root,
    pairs.parallel_eigenvectors,
)
"""C1 to C3, in this order."""
