"""Claims C1 to C3 hold where they should, and fall, alone, where one number is changed."""

import numpy as np
import pytest

import claim_fixtures
import claim_fixtures_pairs
from grainmodes.claims import CLAIMS, check, paper_c
from grainmodes.claims.claim import CONTRADICTED, HOLDS, NOT_RESOLVED, NOT_TESTED

NAMES = ("C1", "C2", "C3")


def pairs_from_the_start(ensemble):
    ensemble["pair_count"] = ensemble["pair_count"] + 1.0


def no_pairs(ensemble):
    for name in ("pair_count", "track_count"):
        ensemble[name] = 0.0 * ensemble[name]


def linear(ensemble):
    ensemble["exceptional_point_exponent_real"] = 2.0 * ensemble["exceptional_point_exponent_real"]


def linear_as_a_pair(ensemble):
    ensemble["exceptional_point_exponent_pair"] = 2.0 * ensemble["exceptional_point_exponent_pair"]


def not_parallel(ensemble):
    ensemble["neighbour_product"] = 0.9 * ensemble["neighbour_product"]


MUTANTS = [
    ("C1", pairs_from_the_start),
    ("C2", linear),
    ("C2", linear_as_a_pair),
    ("C3", not_parallel),
]


def verdicts(ensemble, claims=paper_c.CLAIMS):
    return {verdict.claim: verdict for verdict in check(ensemble, claims)}


def test_the_claims_of_three_papers_stand_in_one_table():
    found = verdicts(claim_fixtures_pairs.ensemble(), CLAIMS)
    assert [name for name in found if name.startswith("C")][: len(NAMES)] == list(NAMES)
    assert {found[name].verdict for name in NAMES} == {HOLDS}


@pytest.mark.parametrize(("name", "mutate"), MUTANTS)
def test_one_changed_number_contradicts_its_claim_alone(name, mutate):
    ensemble = claim_fixtures_pairs.ensemble()
    mutate(ensemble)
    found = verdicts(ensemble)
    fallen = {n: found[n].verdict for n in NAMES if found[n].verdict != HOLDS}
    assert fallen == {name: CONTRADICTED}


def test_samples_without_births_show_nothing_and_one_with_them_is_enough():
    ensemble = claim_fixtures_pairs.ensemble()
    no_pairs(ensemble)
    assert verdicts(ensemble)["C1"].verdict == NOT_RESOLVED
    ensemble["track_count"][..., 2] = 1.0
    found = verdicts(ensemble)["C1"]
    assert found.verdict == HOLDS
    assert "births per unit of strain" in found.explanation


def test_the_product_is_taken_to_the_point_itself():
    """At the nearest states it is 1 − 1e-2; a straight line takes it to 1."""
    ensemble = claim_fixtures_pairs.ensemble()
    steeper = 1.0 - 1e4 * (1.0 - ensemble["neighbour_product"])
    ensemble["neighbour_product"] = steeper
    assert verdicts(ensemble)["C3"].verdict == HOLDS


def test_what_the_ensemble_lacks_is_not_tested_and_named():
    found = verdicts(claim_fixtures.ensemble())
    assert {found[name].verdict for name in NAMES} == {NOT_TESTED}
    assert "pair_count" in found["C1"].explanation
    assert "exceptional_point_kind" in found["C2"].explanation


def test_other_kinds_than_coalescences_are_left_out():
    ensemble = claim_fixtures_pairs.ensemble()
    for name in ("exceptional_point_kind", "exceptional_point_exponent_real"):
        ensemble[name][..., 0] = np.nan if "exponent" in name else 2.0
    found = verdicts(ensemble)["C2"]
    assert found.verdict == HOLDS
    assert "births" not in found.explanation


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("name", ["converged", "jammed"])
def test_lost_samples_are_left_out_without_a_warning(name):
    ensemble = claim_fixtures_pairs.ensemble()
    ensemble[name] = ensemble[name].where(~ensemble["seed"].isin([0, 3]), 0)
    found = verdicts(ensemble)
    assert {found[name].verdict for name in NAMES} == {HOLDS}
