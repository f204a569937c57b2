"""Claims, each a check on an ensemble: a package for every paper, and what all of them share."""

from __future__ import annotations

from grainmodes.claims.claim import Claim, Verdict


def check(ensemble, claims: tuple[Claim, ...]) -> list[Verdict]:
    """The verdict on every claim, in their order.

    Args:
        ensemble: dataset of `grainmodes.ensemble.open_ensemble`; claims whose observables or
            points it lacks are "not asked".
        claims: those of a paper, such as `paper_a.CLAIMS`.
    """
    return [claim(ensemble) for claim in claims]
