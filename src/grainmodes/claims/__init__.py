"""Claims of the papers, each checked on an ensemble: a package per paper, and what they share."""

from __future__ import annotations

from grainmodes.claims import paper_a, paper_b, paper_c
from grainmodes.claims.claim import Claim, Verdict

CLAIMS: tuple[Claim, ...] = (*paper_a.CLAIMS, *paper_b.CLAIMS, *paper_c.CLAIMS)
"""A1 to A19, B1 to B10, then C1 to C9."""


def check(ensemble, claims: tuple[Claim, ...] = CLAIMS) -> list[Verdict]:
    """The verdict on every claim, in their order.

    Args:
        ensemble: dataset of `grainmodes.ensemble.open_ensemble`; claims whose observables or
            points it lacks are "not tested".
        claims: all claims, or those of one paper, such as `paper_a.CLAIMS`.
    """
    return [claim(ensemble) for claim in claims]
