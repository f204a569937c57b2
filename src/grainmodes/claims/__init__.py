"""Claims, each checked on an ensemble: a package per paper, one of our own, and what they share."""

from __future__ import annotations

from pathlib import Path

from grainmodes.claims import own, paper_a, paper_b, paper_c
from grainmodes.claims.claim import NOT_TESTED, Claim, Verdict
from grainmodes.claims.samples import points_left_out
from grainmodes.ensemble import open_ensemble
from grainmodes.ensemble.lost import lost_in_words, lost_samples

CLAIMS: tuple[Claim, ...] = (*paper_a.CLAIMS, *paper_b.CLAIMS, *paper_c.CLAIMS, *own.CLAIMS)
"""A1 to A22, B1 to B14, C1 to C16, last G1 to G4."""


def check(ensemble, claims: tuple[Claim, ...] = CLAIMS) -> list[Verdict]:
    """The verdict on every claim, in their order.

    Args:
        ensemble: dataset of `grainmodes.ensemble.open_ensemble`; claims whose observables or
            points it lacks are "not tested".
        claims: all claims, or those of one paper, such as `paper_a.CLAIMS`.
    """
    return [claim(ensemble) for claim in claims]


def first_tested(paths: list[Path]) -> tuple[list[Verdict], str]:
    """The verdict on every claim by the first of some ensembles that tests it, and their remarks.

    Raises:
        BlockError: a file is not readable, or not an ensemble.
        ValueError: there is no ensemble.
    """
    if not paths:
        raise ValueError("claims: expected at least one ensemble, got none")
    verdicts: list[Verdict] = []
    remarks = []
    for path in paths:
        with open_ensemble(path) as opened:
            found = check(opened)
            remarks_here = (points_left_out(opened), lost_in_words(lost_samples(opened)))
        remark = " ".join(filter(None, remarks_here))
        kept = verdicts or found
        verdicts = [
            new if old.verdict == NOT_TESTED else old for old, new in zip(kept, found, strict=True)
        ]
        if remark:
            remarks.append(remark if len(paths) == 1 else f"{path.parent.name}: {remark}")
    return verdicts, " ".join(remarks)
