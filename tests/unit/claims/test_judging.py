"""How parts with their uncertainty become a verdict."""

import numpy as np
import pytest
from scipy import stats

from grainmodes.claims import CLAIMS
from grainmodes.claims.claim import NOT_TESTED, NotTested, Outcome, claim
from grainmodes.claims.part import (
    CONTRADICTED,
    HOLDS,
    NOT_COMPARABLE,
    NOT_RESOLVED,
    Part,
    verdicts_of,
)
from grainmodes.statistics.estimates import Estimate
from grainmodes.statistics.medians import Median
from grainmodes.statistics.shares import Share


def below_one(value, error=0.1, samples=8, **more):
    return Part(f"at {value}", Estimate(value, error, samples - 1), high=1.0, **more)


def verdict(part):
    return verdicts_of([part])[0]


@pytest.mark.parametrize("samples", [4, 8, 30])
def test_the_quantiles_are_those_of_student(samples):
    hold, contradict = (stats.t.ppf(p, samples - 1) for p in (0.98, 0.995))
    for reach, expected in (
        (-1.01 * hold, HOLDS),
        (-0.99 * hold, NOT_RESOLVED),
        (0.99 * contradict, NOT_RESOLVED),
        (1.01 * contradict, CONTRADICTED),
    ):
        assert verdict(below_one(1.0 + 0.1 * reach, samples=samples)) == expected


@pytest.mark.parametrize(("value", "expected"), [(0.0, HOLDS), (9.0, CONTRADICTED)])
def test_below_four_samples_there_is_no_verdict(value, expected):
    assert verdict(below_one(value, samples=4)) == expected
    assert verdict(below_one(value, samples=3)) == NOT_RESOLVED
    assert verdict(below_one(value, error=np.nan)) == NOT_RESOLVED


def test_both_ends_of_an_interval_are_tests():
    once = 0.1 * stats.t.ppf(0.995, 7)
    twice = 0.1 * stats.t.ppf(0.9975, 7)
    for reach, expected in ((once * 1.01, NOT_RESOLVED), (twice * 1.01, CONTRADICTED)):
        assert verdict(Part("", Estimate(1.0 + reach, 0.1, 7), 0.0, 1.0)) == expected
        assert verdict(Part("", Estimate(-reach, 0.1, 7), 0.0, 1.0)) == expected


def test_a_number_expected_outside_an_interval():
    for value, expected in ((0.5, CONTRADICTED), (1.01, NOT_RESOLVED), (2.0, HOLDS), (-1, HOLDS)):
        part = Part("", Estimate(value, 0.1, 7), 0.0, 1.0, outside=True)
        assert verdict(part) == expected
    assert part.margin == 1.0


def test_the_more_parts_a_claim_has_the_farther_one_must_lie_outside():
    outside = below_one(1.0 + 0.1 * stats.t.ppf(0.9975, 7))
    inside = [below_one(0.0)] * 2
    assert verdicts_of([outside])[0] == CONTRADICTED
    assert verdicts_of([outside, *inside])[0] == NOT_RESOLVED


def test_parts_that_cannot_be_judged_cost_no_correction():
    outside = below_one(1.0 + 0.1 * stats.t.ppf(0.9975, 7))
    silent = [below_one(0.0, samples=2), below_one(0.0, needs="N ≥ 4096")] * 3
    assert verdicts_of([outside, *silent])[0] == CONTRADICTED


def test_four_of_four_neither_hold_above_one_half_nor_contradict():
    assert verdict(Part("", Share(4, 4), 0.5)) == NOT_RESOLVED
    assert verdict(Part("", Share(6, 6), 0.5)) == HOLDS
    assert verdict(Part("", Share(0, 7), 0.5)) == NOT_RESOLVED
    assert verdict(Part("", Share(0, 8), 0.5)) == CONTRADICTED


def test_a_median_is_judged_by_the_samples_on_either_side():
    assert verdict(Part("", Median((-9.0, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1e9)), 0.5)) == NOT_RESOLVED
    assert verdict(Part("", Median((1.0, 1.1, 1.2, 1.3, 1.4, 1e9)), 0.5)) == HOLDS


@pytest.mark.parametrize(
    ("number", "limits", "parts", "fewest"),
    [
        (lambda n: Share(0, n), (0.5, np.inf), 1, 8),
        (lambda n: Share(0, n), (0.5, np.inf), 9, 11),
        (lambda n: Median((5.0,) * n), (-1.0, 1.0), 1, 9),
        (lambda n: Median((5.0,) * n), (-1.0, 1.0), 9, 12),
    ],
)
def test_the_fewest_samples_that_contradict_are_those_of_the_docs(number, limits, parts, fewest):
    """docs/claims.md, "How a verdict is reached"."""
    for size, expected in ((fewest - 1, NOT_RESOLVED), (fewest, CONTRADICTED)):
        found = verdicts_of([Part("", number(size), *limits)] * parts)
        assert set(found) == {expected}


def claim_with(parts, note=""):
    @claim("A0", unit="1")
    def some_numbers(_ensemble):
        """Some numbers.

        Asked of: every number.

        Criterion: below 1.
        """
        return Outcome(parts, note)

    return some_numbers(None)


def test_the_most_certain_contradiction_decides_and_is_named():
    found = claim_with({"numbers": [below_one(x) for x in (0.5, 3.0, 4.0)]}, "A note.")
    assert (found.verdict, found.where, found.measured) == (CONTRADICTED, "at 4.0", 4.0)
    assert (found.statement, found.criterion) == ("Some numbers.", "below 1.")
    assert found.asked_of == "every number."
    assert (found.printed, found.needed) == ("4.00(10)", "")
    assert found.low == pytest.approx(4.0 - 0.1 * stats.t.ppf(0.975, 7))
    assert found.explanation == (
        "Parts that are contradicted: 2 of 3, the most certain first. at 4.0: 4.00(10); "
        "at 3.0: 3.00(10). A note."
    )


def test_an_unresolved_claim_names_the_samples_that_would_decide_it():
    found = claim_with({"numbers": [below_one(0.0), below_one(0.9)]})
    assert (found.verdict, found.measured) == (NOT_RESOLVED, 0.9)
    assert found.needed == "about 70 samples at at 0.9"
    assert claim_with({"numbers": [below_one(0.9999)]}).needed == "more samples at at 0.9999"
    three = claim_with({"numbers": [below_one(0.0, samples=3)]})
    assert three.needed == "about 4 samples at at 0.0"
    none = claim_with({"numbers": [below_one(0.9), below_one(np.nan), below_one(0.95)]})
    assert none.needed == "about 271 samples at at 0.95"


def test_a_part_that_must_exist_and_does_not_leaves_a_claim_untested():
    found = claim_with({"numbers": [below_one(0.0)], "k_T = 0": []})
    assert (found.verdict, found.needed) == (NOT_TESTED, "k_T = 0")
    assert (
        found.explanation
        == "The ensemble lacks k_T = 0. Parts that hold: 1 of 1. at 0.0: 0.00(10)."
    )
    assert claim_with({"numbers": [below_one(9.0)], "k_T = 0": []}).verdict == CONTRADICTED
    assert claim_with({"numbers": [], "k_T = 0": []}).needed == "numbers and k_T = 0"


def test_what_is_not_comparable_is_told_apart_from_what_is_contradicted():
    sound = below_one(9.0, needs="N ≥ 4096")
    found = claim_with({"numbers": [below_one(0.0), sound]})
    assert (found.verdict, found.measured, found.needed) == (NOT_COMPARABLE, 9.0, "N ≥ 4096")
    assert "are not comparable at this size: 1 of 2. at 9.0: 9.00(10)." in found.explanation
    assert claim_with({"numbers": [below_one(9.0), sound]}).verdict == CONTRADICTED


def test_samples_without_a_number_are_stated():
    found = claim_with({"numbers": [Part("here", Estimate(0.0, 0.1, 5, left_out=3), high=1.0)]})
    assert "here: 0.00(10) (3 samples without a number)." in found.explanation


def test_what_the_ensemble_lacks_is_named_and_needed():
    @claim("A0", unit="1")
    def nothing(_ensemble):
        """Nothing.

        Asked of: nothing.

        Criterion: none.
        """
        raise NotTested("two N")

    found = nothing(None)
    assert (found.verdict, found.needed, found.printed) == (NOT_TESTED, "two N", "-")
    assert found.explanation == "The ensemble lacks two N."


def test_every_claim_says_what_it_is_asked_of():
    assert all(text in claim.__doc__ for claim in CLAIMS for text in ("Asked of: ", "Criterion: "))
