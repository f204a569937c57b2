"""Claims C4 to C7 hold where they should, and fall, alone, where one number is changed."""

import numpy as np
import pytest

import claim_fixtures
import claim_fixtures_release
from claim_mutants_release import MUTANTS
from grainmodes.claims import CLAIMS, check, paper_c
from grainmodes.claims.claim import CONTRADICTED, HOLDS, NOT_RESOLVED, NOT_TESTED

NAMES = ["C4", "C5", "C6", "C7"]
NEEDED = {
    "C4": "release_spiral_opening",
    "C5": "release_change_square",
    "C6": "release_second_time",
    "C7": "release_largest_square",
}


def verdicts(ensemble):
    found = {verdict.claim: verdict for verdict in check(ensemble, paper_c.CLAIMS)}
    return {name: found[name] for name in NAMES}


def test_they_hold_and_stand_in_the_table_of_all():
    assert {v.verdict for v in verdicts(claim_fixtures_release.ensemble()).values()} == {HOLDS}
    everything = [v.claim for v in check(claim_fixtures_release.ensemble(), CLAIMS)]
    assert [name for name in everything if name in NAMES] == NAMES


@pytest.mark.parametrize(("name", "mutate"), MUTANTS)
def test_one_changed_number_contradicts_its_claim_alone(name, mutate):
    ensemble = claim_fixtures_release.ensemble()
    mutate(ensemble)
    found = verdicts(ensemble)
    assert {n: v.verdict for n, v in found.items() if v.verdict != HOLDS} == {name: CONTRADICTED}


def test_a_late_end_of_the_growth_contradicts_it():
    ensemble = claim_fixtures_release.ensemble()
    later = ensemble["release_change_time"] + 5.0 / ensemble["release_rate_linear"]
    ensemble["release_end_time"] = later
    assert verdicts(ensemble)["C5"].verdict == CONTRADICTED


@pytest.mark.parametrize("name", NEEDED)
def test_what_the_ensemble_lacks_is_not_tested_and_named(name):
    verdict = verdicts(claim_fixtures_release.ensemble().drop_vars(NEEDED[name]))[name]
    assert verdict.verdict == NOT_TESTED
    assert NEEDED[name] in verdict.explanation


def test_without_releases_nothing_is_tested():
    assert {v.verdict for v in verdicts(claim_fixtures.ensemble()).values()} == {NOT_TESTED}


def test_one_sample_decides_nothing():
    one = claim_fixtures_release.ensemble().isel(seed=[0])
    assert {v.verdict for v in verdicts(one).values()} <= {NOT_TESTED, NOT_RESOLVED}


def test_samples_without_a_second_instability_are_counted():
    ensemble = claim_fixtures_release.ensemble()
    ensemble["release_second_time"][..., :3, :] = np.nan
    verdict = verdicts(ensemble)["C6"]
    assert verdict.verdict == HOLDS
    assert "13 of 16 runs" in verdict.explanation
    ensemble["release_second_time"][...] = np.nan
    verdict = verdicts(ensemble)["C6"]
    assert verdict.verdict == NOT_TESTED
    assert "second instability" in verdict.explanation


def test_the_note_has_the_depth_and_the_run_in_between():
    found = verdicts(claim_fixtures_release.ensemble())
    assert "M and A oscillate by 0.2" in found["C5"].explanation
    assert "η_0 = 1 ω_i" in found["C7"].explanation
    assert "at the rate 0.5005103(67) ω_i" in found["C7"].explanation


def test_the_note_counts_runs_that_reach_a_second_instability():
    ensemble = claim_fixtures_release.ensemble()
    second = ensemble["release_second_time"]
    ensemble["release_second_time"] = second.where(second["damping"] == 0)
    explanation = verdicts(ensemble)["C7"].explanation
    for times, reached in ((0, 16), (0.1, 0), (1, 0)):
        assert f"At η_0 = {times} ω_i, φ = 0.9, κ = 1 {reached} of 16 reach a second" in explanation
