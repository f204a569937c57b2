"""Every claim of paper B holds where it should, and falls, alone, where one number is changed."""

import json

import numpy as np
import pytest

import claim_fixtures
import claim_fixtures_shear
from claim_mutants_shear import MUTANTS, SECOND_MUTANTS
from grainmodes.claims import check, paper_a, paper_b, paper_c
from grainmodes.claims.claim import CONTRADICTED, HOLDS, NOT_COMPARABLE, NOT_RESOLVED, NOT_TESTED
from grainmodes.claims.paper_b import events

NAMES = [f"B{number}" for number in range(1, 15)]
NEEDED = {
    "B1": "curve_strain",
    "B2": "coarse_strain",
    "B3": "curve_lowest_eigenvalue",
    "B4": "curve_g_xy",
    "B5": "bracket_min_step",
    "B6": "last_path_error",
    "B7": "event_quadrupole",
    "B8": "curve_g_xy",
    "B9": "event_reopened",
    "B10": "g_simulated",
    "B11": "event_asymmetry_after",
    "B12": "rate_difference",
    "B13": "loop_left",
    "B14": "event_g_after",
}


@pytest.fixture(autouse=True)
def small_quadrupoles(monkeypatch):
    """The fixture has few grains, in which B7 is judged all the same."""
    monkeypatch.setattr(events, "QUADRUPOLE_N", claim_fixtures_shear.N)


PAPERS = (*paper_a.CLAIMS, *paper_b.CLAIMS, *paper_c.CLAIMS)


def verdicts(ensemble, claims=paper_b.CLAIMS):
    return {verdict.claim: verdict for verdict in check(ensemble, claims)}


def test_both_papers_stand_in_one_table():
    found = verdicts(claim_fixtures_shear.ensemble(), PAPERS)
    of_c = [name for name in found if name.startswith("C")]
    assert list(found) == [*(f"A{number}" for number in range(1, 23)), *NAMES, *of_c]
    assert {name for name, v in found.items() if v.verdict == NOT_TESTED} == set(of_c)
    assert {v.verdict for name, v in found.items() if name not in of_c} == {HOLDS}


@pytest.mark.parametrize(("name", "mutate"), [*MUTANTS.items(), *SECOND_MUTANTS.items()])
def test_one_changed_number_contradicts_its_claim_alone(name, mutate):
    ensemble = claim_fixtures_shear.ensemble()
    mutate(ensemble)
    found = verdicts(ensemble, PAPERS)
    fallen = {n: v.verdict for n, v in found.items() if v.verdict not in (HOLDS, NOT_TESTED)}
    assert fallen == {name: CONTRADICTED}


def test_a_simulation_that_differs_contradicts_the_rigidity_before_strain():
    ensemble = claim_fixtures_shear.ensemble()
    ensemble["g_simulated"] = 1.05 * ensemble["g_simulated"]
    fallen = {n: v.verdict for n, v in verdicts(ensemble).items() if v.verdict != HOLDS}
    assert fallen == {"B10": CONTRADICTED}


@pytest.mark.parametrize("name", NEEDED)
def test_what_the_ensemble_lacks_is_not_tested_and_named(name):
    verdict = verdicts(claim_fixtures_shear.ensemble().drop_vars(NEEDED[name]))[name]
    assert verdict.verdict == NOT_TESTED
    assert NEEDED[name] in verdict.explanation


def test_hertzian_grains_are_not_those_of_paper_b():
    ensemble = claim_fixtures_shear.ensemble()
    ensemble.attrs["config"] = json.dumps({})
    found = verdicts(ensemble).values()
    assert {verdict.verdict for verdict in found} == {NOT_TESTED}
    assert sum("harmonic grains" in verdict.explanation for verdict in found) == 14


def test_without_shear_only_the_rigidity_before_strain_is_tested():
    ensemble = claim_fixtures.ensemble()
    ensemble.attrs["config"] = json.dumps({"contact_law": {"normal": "harmonic"}})
    found = verdicts(ensemble)
    assert {name for name, v in found.items() if v.verdict != NOT_TESTED} == {"B10"}


def test_one_sample_and_no_event_decide_nothing():
    one = claim_fixtures_shear.ensemble().isel(seed=[0])
    assert {v.verdict for v in verdicts(one).values()} <= {NOT_TESTED, NOT_RESOLVED}
    calm = claim_fixtures_shear.ensemble()
    for name in list(calm):
        if name.startswith("event_"):
            calm[name] = calm[name] * np.nan
    found = verdicts(calm)
    assert {found[name].verdict for name in ("B3", "B4", "B7", "B9", "B11", "B14")} == {NOT_TESTED}
    assert found["B8"].verdict in (HOLDS, CONTRADICTED)


def test_failed_samples_are_left_out():
    ensemble = claim_fixtures_shear.ensemble()
    ensemble["curve_g_xy"][..., 0, :] *= 3.0
    ensemble["converged"][..., 0] = 0.0
    assert {v.verdict for v in verdicts(ensemble).values()} == {HOLDS}


def test_the_note_has_events_with_the_same_network_before_and_after():
    ensemble = claim_fixtures_shear.ensemble()
    ensemble["event_reopened"] = ensemble["event_opened"].copy()
    ensemble["event_opened"] = 0.0 * ensemble["event_opened"]
    verdict = verdicts(ensemble)["B9"]
    assert verdict.verdict == HOLDS
    assert (
        "512 did both; the network is the same before and after in 512 of 512 events"
        in verdict.explanation
    )


def test_complex_pairs_are_counted():
    ensemble = claim_fixtures_shear.ensemble()
    pairs = ensemble["event_complex_pairs_after"]
    ensemble["event_complex_pairs_after"] = pairs + (pairs["event"] == 2)
    assert "complex pairs in 16 of 512 states after events" in verdicts(ensemble)["B11"].explanation


def test_small_boxes_and_short_shears_are_not_comparable(monkeypatch):
    monkeypatch.setattr(events, "QUADRUPOLE_N", 1024)
    ensemble = claim_fixtures_shear.ensemble()
    short = ensemble["curve_strain"].where(ensemble["curve_strain"] < 0.3)
    found = verdicts(ensemble.assign(curve_strain=short))
    assert {name: found[name].needed for name in ("B7", "B14")} == {
        "B7": "N ≥ 1024",
        "B14": "shear to γ = 0.34",
    }
    assert {found[name].verdict for name in ("B7", "B14")} == {NOT_COMPARABLE}


def test_large_strains_are_needed_for_what_depends_on_the_brackets():
    ensemble = claim_fixtures_shear.ensemble()
    short = ensemble["coarse_strain"].where(ensemble["coarse_strain"] < 0.3)
    verdict = verdicts(ensemble.assign(coarse_strain=short))["B2"]
    assert (verdict.verdict, verdict.needed) == (NOT_COMPARABLE, "shear to γ = 0.34")
