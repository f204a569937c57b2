"""Claims on released states hold where they should, and fall, alone, where a number is changed."""

import numpy as np
import pytest

import claim_fixtures
import claim_fixtures_release
from claim_mutants_release import MUTANTS, ends_after_one_time
from grainmodes.claims import CLAIMS, check, paper_c
from grainmodes.claims.claim import (
    CONTRADICTED,
    HOLDS,
    NOT_COMPARABLE,
    NOT_RESOLVED,
    NOT_TESTED,
)

NAMES = ["C4", "C5", "C6", "C7", "C10", "C11", "C12", "C13", "C14", "C15", "C16"]
NEEDED = {
    "C4": "release_spiral_opening",
    "C5": "release_change_time",
    "C6": "release_second_time",
    "C7": "release_threshold",
    "C10": "release_end_time",
    "C11": "release_death_time",
    "C12": "release_noise_rate",
    "C13": "release_diffusion_exponent",
    "C14": "release_binary_tail_after",
    "C15": "release_pressure_by_z_before",
    "C16": "release_growth_sliding",
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


def test_growth_that_ends_late_in_m_contradicts_c5_where_it_is_slow():
    """In a fast growth, ω_i above 0.01 ω_r, M grows too much in a turn to say."""
    ensemble = claim_fixtures_release.ensemble()
    square = ensemble["release_end_square"]
    for scale, verdict in ((1.0, CONTRADICTED), (100.0, HOLDS)):
        fast = ensemble.copy()
        fast["release_end_square"] = 1e3 * square
        fast["release_frequency_linear"] = ensemble["release_frequency_linear"] / scale
        for name in ("displacement", "rotation"):
            fast[f"release_{name}_frequency"] = ensemble[f"release_{name}_frequency"] / scale
        slowest = fast.isel(release_state=[0]) if scale > 1.0 else fast
        assert verdicts(slowest)["C5"].verdict == verdict


def test_growth_that_ends_after_one_time_contradicts_c10():
    ensemble = claim_fixtures_release.ensemble()
    ends_after_one_time(ensemble)
    found = verdicts(ensemble)["C10"]
    assert found.verdict == CONTRADICTED
    assert found.measured == pytest.approx(-0.5, abs=0.05)


def test_one_decade_does_not_show_how_the_end_depends_on_the_rate():
    found = verdicts(claim_fixtures_release.ensemble().isel(release_state=[0, 1]))["C10"]
    assert found.verdict == NOT_TESTED
    assert "decades" in found.explanation


def test_a_fast_rate_alone_contradicts_c5_and_c7():
    ensemble = claim_fixtures_release.ensemble()
    ensemble["release_displacement_rate"] = 1.03 * ensemble["release_displacement_rate"]
    found = verdicts(ensemble)
    fallen = {name for name, verdict in found.items() if verdict.verdict == CONTRADICTED}
    assert fallen == {"C5", "C7"}


def test_a_plateau_shorter_than_a_growth_time_contradicts_c6():
    ensemble = claim_fixtures_release.ensemble()
    soon = ensemble["release_end_time"] + 0.2 / ensemble["release_rate_linear"]
    ensemble["release_second_time"] = soon
    assert verdicts(ensemble)["C6"].verdict == CONTRADICTED


def test_grains_that_have_not_left_their_places_show_no_diffusion():
    ensemble = claim_fixtures_release.ensemble()
    square = ensemble["release_after_mean_square_displacement"]
    ensemble["release_after_mean_square_displacement"] = 0.1 * square
    found = verdicts(ensemble)["C13"]
    assert found.verdict == NOT_COMPARABLE
    assert found.needed == "runs to M ≥ d²"


def test_a_z_that_few_samples_have_is_not_judged():
    ensemble = claim_fixtures_release.ensemble()
    before = ensemble["release_pressure_by_z_before"]
    before[..., 3:, :, 4] = np.nan
    found = verdicts(ensemble)["C15"]
    assert found.verdict == HOLDS
    assert "6 of 6" in found.explanation


def test_states_with_a_single_pair_do_not_show_which_pair_dominates():
    ensemble = claim_fixtures_release.ensemble()
    ensemble["release_start_pairs"] = 0.0 * ensemble["release_start_pairs"] + 1.0
    found = verdicts(ensemble)["C12"]
    assert found.verdict == NOT_TESTED
    assert "more than one pair" in found.explanation


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
    ensemble["release_second_time"][..., :3, :, :] = np.nan
    verdict = verdicts(ensemble)["C6"]
    assert verdict.verdict == HOLDS
    assert "13 of 16 runs" in verdict.explanation
    ensemble["release_second_time"][...] = np.nan
    for name in ("C6", "C13", "C14", "C15", "C16"):
        verdict = verdicts(ensemble)[name]
        assert verdict.verdict == NOT_TESTED
        assert "second instability" in verdict.explanation


def test_a_rate_that_no_sample_reaches_is_left_out():
    ensemble = claim_fixtures_release.ensemble()
    for name in [name for name in ensemble if name.startswith("release_")]:
        ensemble[name] = ensemble[name].where(ensemble["release_state"] != 2)
    found = verdicts(ensemble)
    assert found["C5"].verdict == HOLDS
    assert "2.0e-05" not in found["C5"].explanation and "2.0e-04" in found["C5"].explanation


def test_the_notes_have_what_is_not_judged():
    found = verdicts(claim_fixtures_release.ensemble())
    assert "M oscillates by 0.19" in found["C5"].explanation
    assert "the threshold is 4" in found["C7"].explanation
    assert "under η_0 = 1 ω_i M grows at 0.75" in found["C7"].explanation


def test_the_note_counts_runs_that_reach_a_second_instability():
    ensemble = claim_fixtures_release.ensemble()
    second = ensemble["release_second_time"]
    ensemble["release_second_time"] = second.where(second["damping"] == 0)
    explanation = verdicts(ensemble)["C7"].explanation
    assert "0 of 16 reach a second instability" in explanation


@pytest.mark.parametrize(
    ("runs", "needed"),
    [
        ([0], "released states that grow under a drag"),
        ([0, 1, 2], "runs with η_0 above twice the threshold"),
        ([0, 2, 4], "runs with η_0 < 0.5 ω_i"),
    ],
)
def test_c7_needs_a_weak_and_a_strong_damping(runs, needed):
    """Growth rates alone do not show that a strong damping suppresses the growth."""
    found = verdicts(claim_fixtures_release.ensemble().isel(damping=runs))["C7"]
    assert found.verdict == NOT_TESTED
    assert needed in found.needed
    assert "ω_i; ." not in found.explanation
