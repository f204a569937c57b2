"""How parts with errors become a verdict."""

import numpy as np
import pytest

from grainmodes.claims.claim import CONTRADICTED, HOLDS, NOT_RESOLVED, Outcome, Part, claim
from grainmodes.statistics.estimates import Estimate


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        (0.5, 0.1, HOLDS),
        (0.85, 0.1, NOT_RESOLVED),
        (1.2, 0.1, NOT_RESOLVED),
        (1.31, 0.1, CONTRADICTED),
        (-0.31, 0.1, CONTRADICTED),
        (0.5, np.nan, NOT_RESOLVED),
    ],
)
def test_a_part_needs_two_errors_to_hold_and_three_to_be_contradicted(value, error, expected):
    assert Part("here", Estimate(value, error), 0.0, 1.0).verdict == expected


def test_the_worst_part_decides_and_is_named():
    parts = {"good": 0.5, "bad": 3.0, "worse": 4.0}

    @claim("A0", unit="1")
    def three_numbers(ensemble):
        """Three numbers.

        Criterion: below 1.
        """
        return Outcome([Part(name, Estimate(x, 0.1), high=1.0) for name, x in parts.items()])

    verdict = three_numbers(None)
    assert (verdict.verdict, verdict.where, verdict.measured) == (CONTRADICTED, "worse", 4.0)
    assert (verdict.statement, verdict.criterion) == ("Three numbers.", "below 1.")
    assert (
        "are contradicted: 2 of 3, the farthest outside first. worse: 4.00(10); bad: 3.00(10)."
        in verdict.explanation
    )
