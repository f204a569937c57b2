"""Every claim holds where it should, and falls, alone, where one number is changed."""

import re

import numpy as np
import pytest

import claim_fixtures
from claim_mutants import MUTANTS, SECOND_MUTANTS, no_overlap, other_dynamics, spread_rattlers
from grainmodes.claims import check
from grainmodes.claims.claim import (
    CONTRADICTED,
    HOLDS,
    NOT_COMPARABLE,
    NOT_RESOLVED,
    NOT_TESTED,
)
from grainmodes.claims.paper_a import CLAIMS

NAMES = [f"A{number}" for number in range(1, 23)]


def verdicts(ensemble):
    return {verdict.claim: verdict for verdict in check(ensemble, CLAIMS)}


def test_every_claim_holds_where_it_should():
    found = verdicts(claim_fixtures.ensemble())
    assert list(found) == NAMES
    assert {name: v.verdict for name, v in found.items() if v.verdict != HOLDS} == {}
    assert all(np.isfinite([v.measured, v.low, v.high]).all() for v in found.values())


@pytest.mark.parametrize(("name", "mutate"), [*MUTANTS.items(), *SECOND_MUTANTS])
def test_one_changed_number_contradicts_its_claim_alone(name, mutate):
    ensemble = claim_fixtures.ensemble()
    mutate(ensemble)
    fallen = {n: v.verdict for n, v in verdicts(ensemble).items() if v.verdict != HOLDS}
    assert fallen == {name: CONTRADICTED}


NEEDED = {
    "A1": "g_simulated",
    "A2": "phi_jamming",
    "A3": "g",
    "A4": "g",
    "A5": "g",
    "A6": "g_nonaffine_loaded",
    "A7": "psi_rotational",
    "A8": "psi_rotational",
    "A9": "psi_rotational",
    "A10": "psi_rotational",
    "A11": "psi_rotational",
    "A12": "bin_count_hessian",
    "A13": "eigenvalue_rattlers",
    "A14": "psi_rotational",
    "A15": "psi_rotational",
    "A16": "g_forward_by_strain",
    "A17": "g_translational",
    "A18": "verlet_order_position",
    "A19": "complex_pairs_at_rest",
    "A20": "psi_rotational",
    "A21": "field_difference",
    "A22": "participation_ratio",
}


@pytest.mark.parametrize("variable", sorted(set(NEEDED.values())))
def test_what_the_ensemble_lacks_is_not_tested_and_named(variable):
    found = verdicts(claim_fixtures.ensemble().drop_vars(variable))
    for name in (name for name in NAMES if NEEDED[name] == variable):
        assert found[name].verdict == NOT_TESTED
        assert variable in found[name].explanation
    others = {n: v.verdict for n, v in found.items() if variable not in v.explanation}
    assert set(others.values()) == {HOLDS}


@pytest.mark.parametrize(
    ("grid", "names", "lack"),
    [
        ({"kt": [1e-8, 1e-4, 2.0]}, ("A4", "A5", "A11"), "k_T = 0"),
        ({"kt": [0.0, 1e-10, 1e-8]}, ("A6", "A8"), "k_T/k_N"),
        ({"phi": [0.90]}, ("A2", "A5", "A6", "A15"), "area fractions"),
        ({"n": [4096]}, ("A14",), "two N"),
    ],
)
def test_points_that_the_grid_lacks_are_named(grid, names, lack):
    found = verdicts(claim_fixtures.ensemble().sel(grid))
    for name in names:
        assert found[name].verdict == NOT_TESTED
        assert lack in found[name].explanation


@pytest.mark.parametrize(
    "grid", [{"kt": [0.0]}, {"kt": [10.0]}, {"phi": [0.90], "kt": [1e-8]}, {"seed": [0]}]
)
def test_an_ensemble_of_few_points_has_no_verdict_against_a_claim(grid):
    found = check(claim_fixtures.ensemble().sel(grid), CLAIMS)
    assert [verdict.claim for verdict in found] == NAMES
    assert CONTRADICTED not in {verdict.verdict for verdict in found}


def test_points_that_were_not_computed_change_no_verdict():
    ensemble = claim_fixtures.ensemble()
    larger = ensemble.reindex(n=[256, 272, 4096, 128], phi=[0.86, 0.87, 0.88, 0.90])
    assert {v.verdict for v in check(larger, CLAIMS)} == {HOLDS}


def test_failed_and_unjammed_samples_are_left_out():
    ensemble = claim_fixtures.ensemble()
    ensemble["g_simulated"][..., 0] *= 3.0
    ensemble["converged"][..., 0] = 0.0
    ensemble["g_simulated"][..., 1] = 7.0
    ensemble["jammed"][..., 1] = 0.0
    assert verdicts(ensemble)["A1"].verdict == HOLDS


def test_bins_give_the_verdicts_of_the_modes():
    by_mode = verdicts(claim_fixtures.ensemble())
    by_bin = verdicts(claim_fixtures.bins_of(claim_fixtures.ensemble()))
    for name in ("A7", "A8", "A9", "A10", "A11", "A14", "A15"):
        modes, bins = by_mode[name], by_bin[name]
        assert bins.verdict == modes.verdict == HOLDS
        if bins.where == modes.where:
            assert bins.measured == pytest.approx(modes.measured, abs=0.03)
    assert sum(by_bin[name].where == by_mode[name].where for name in by_mode) > 12


def test_the_loaded_step_stands_beside_the_sign_change():
    verdict = verdicts(claim_fixtures.ensemble())["A6"]
    assert "positive in 0 of 384 samples" in verdict.explanation
    assert "2.2(0) at φ = 0.86" in verdict.explanation


def test_a_sign_that_never_changes_contradicts_the_sign_change():
    ensemble = claim_fixtures.ensemble()
    ensemble["g_nonaffine"] = -0.01 - np.abs(ensemble["g_nonaffine"])
    verdict = verdicts(ensemble)["A6"]
    assert verdict.verdict == CONTRADICTED
    assert verdict.where.endswith("κ = 10") and "κ* =" not in verdict.explanation


@pytest.mark.parametrize("mutate", [lambda ensemble: None, no_overlap, spread_rattlers])
def test_the_size_alone_decides_what_is_comparable(mutate):
    """In a box smaller than A's neither a gap nor an overlap, with rattlers or without, counts."""
    ensemble = claim_fixtures.ensemble()
    mutate(ensemble)
    small = verdicts(ensemble.assign_coords(n=[256, 4095, 128]))
    found = {n: (v.verdict, v.needed) for n, v in small.items() if v.verdict != HOLDS}
    assert found == dict.fromkeys(("A8", "A13"), (NOT_COMPARABLE, "N ≥ 4096"))


@pytest.mark.parametrize(("name", "mutate"), [("A8", no_overlap), ("A13", spread_rattlers)])
def test_in_a_box_of_the_papers_size_the_same_numbers_contradict(name, mutate):
    ensemble = claim_fixtures.ensemble()
    mutate(ensemble)
    fallen = {n: v.verdict for n, v in verdicts(ensemble).items() if v.verdict != HOLDS}
    assert fallen == {name: CONTRADICTED}


def test_small_systems_are_not_compared_where_single_packings_decide():
    found = verdicts(claim_fixtures.ensemble().assign_coords(n=[32, 64, 128]))
    needed = {name: v.needed for name, v in found.items() if v.verdict == NOT_COMPARABLE}
    assert {name: needed.pop(name) for name in ("A8", "A13")} == dict.fromkeys(
        ("A8", "A13"), "N ≥ 4096"
    )
    assert needed == dict.fromkeys(("A3", "A14", "A16"), "N ≥ 256")


def test_one_packing_without_rigidity_decides_no_claim():
    ensemble = claim_fixtures.ensemble()
    ensemble["g"][{"seed": 3, "kt": 1}] *= -1e-3
    ensemble["g_forward_by_strain"][{"seed": 5, "diagnostic": 0}] *= -1e-3
    found = verdicts(ensemble)
    assert {found[name].verdict for name in ("A3", "A16")} == {HOLDS}


@pytest.mark.parametrize(
    ("name", "mutate"),
    [("A1", other_dynamics), *((name, MUTANTS[name]) for name in ("A3", "A16", "A21"))],
)
def test_eight_seeds_can_contradict_a_claim_that_is_asked_of_many_points(name, mutate):
    ensemble = claim_fixtures.ensemble()
    ensemble["g_forward_damped"] *= 1.0 + 1e-3 * claim_fixtures.noise(ensemble, 0.2)
    ensemble["g_forward_by_strain"] *= 1.0 + ensemble["diagnostic_strain"] * (
        claim_fixtures.noise(ensemble, 0.2)
    )
    mutate(ensemble)
    assert verdicts(ensemble.isel(seed=range(8)))[name].verdict == CONTRADICTED


def test_the_peak_is_reported_as_what_it_is():
    ensemble = claim_fixtures.ensemble()
    assert "% beside ω_R" in verdicts(ensemble)["A9"].explanation


@pytest.mark.parametrize("kts", [[0.0], [1e-8], [1.0], [0.0, 1e-8]])
def test_explanations_of_few_stiffnesses_are_whole_sentences(kts):
    """No list in them is empty, and no part stands there twice."""
    ensemble = claim_fixtures.ensemble().sel(kt=kts)
    for verdict in verdicts(ensemble).values():
        text = verdict.explanation.replace(" ... ", " to ")
        assert not re.findall(r" [.,;]|  |\.\.| $", text), text
        assert len(set(_listed(text))) == len(_listed(text)), text


def _listed(explanation):
    return re.findall(r"(?:first\. |; )([^;]+?): ", explanation)


def test_many_modes_of_few_packings_are_no_independent_samples():
    """Four seeds at three φ, two modes each: four of four seeds, not 24 of 24 modes."""
    found = verdicts(claim_fixtures.ensemble().isel(seed=range(4)))["A13"]
    assert found.verdict == NOT_RESOLVED
    assert "4 of 4 [0.40, 1.00]" in found.printed


@pytest.mark.parametrize(
    ("name", "kappa", "parts"), [("A1", 1.5e-4, 36), ("A1", 0.7, 36), ("A7", 0.7, 9)]
)
def test_a_stiffness_that_no_study_of_a_has_is_judged_too(name, kappa, parts):
    """κ = 0.01 of the ensemble is called by another name between the ranges of A."""
    ensemble = claim_fixtures.ensemble()
    kts = ensemble["kt"].to_numpy()
    found = verdicts(ensemble.assign_coords(kt=np.where(kts == 1e-2, kappa, kts)))[name]
    assert f"of {parts}" in found.explanation
