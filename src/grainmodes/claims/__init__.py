"""Claims, each checked on an ensemble: a package per paper, one of our own, and what they share."""

from __future__ import annotations

from dataclasses import replace
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

    Of several ensembles, the explanation names the one that decided, which for a claim that none of
    them tests is the first with some of its parts.

    Raises:
        BlockError: a file is not readable, or not an ensemble.
        ValueError: there is no ensemble.
    """
    if not paths:
        raise ValueError("expected at least one ensemble, got none")
    verdicts: list[Verdict] = []
    remarks = []
    for path in paths:
        with open_ensemble(path) as opened:
            found = check(opened)
            remarks_here = (points_left_out(opened), lost_in_words(lost_samples(opened)))
        remark = " ".join(filter(None, remarks_here))
        if len(paths) > 1:
            found = [_named(verdict, path.parent.name) for verdict in found]
            remark = remark and f"{path.parent.name}: {remark}"
        verdicts = [_earlier(*pair) for pair in zip(verdicts or found, found, strict=True)]
        remarks += [remark] if remark else []
    return verdicts, " ".join(remarks)


def _named(verdict: Verdict, study: str) -> Verdict:
    return replace(verdict, explanation=f"Ensemble {study}: {verdict.explanation}")


def _earlier(old: Verdict, new: Verdict) -> Verdict:
    """The verdict of the earlier ensemble, unless only the later one tests the claim, or a part."""
    tests_more = new.verdict != NOT_TESTED or bool(new.where and not old.where)
    return new if old.verdict == NOT_TESTED and tests_more else old
