"""The own claims hold where they should, and fall, alone, where one number is changed."""

import json

import numpy as np
import pytest

import claim_fixtures
import claim_fixtures_laws
from claim_mutants import cross_at
from grainmodes.claims import check, own
from grainmodes.claims.claim import CONTRADICTED, HOLDS, NOT_TESTED
from grainmodes.claims.own.memory import KEEP_DISPLACEMENT, KEEP_FORCE


def verdicts(ensemble):
    return {verdict.claim: verdict for verdict in check(ensemble, own.CLAIMS)}


def with_laws():
    """Hertzian grains under four laws; pairs exist where springs keep their displacement."""
    dataset = claim_fixtures_laws.ensemble()
    dataset.attrs["config"] = json.dumps({})
    pairs = dataset["comparison_pairs_sticking_smoothed_coulomb"]
    for law in KEEP_DISPLACEMENT:
        dataset[f"comparison_pairs_sticking_{law}"] = pairs.copy()
    for law in KEEP_FORCE:
        dataset[f"comparison_pairs_sticking_{law}"] = 0.0 * pairs
    return dataset


def constant_crossing(ensemble):
    cross_at(ensemble, 4.0)


def rising_crossing(ensemble):
    """κ* rises with φ, in the range of the claim."""
    logarithm = np.log(ensemble["kt"].clip(1e-12) / (2.0 + 5.0 * (ensemble["phi"] - 0.86)))
    ensemble["g_nonaffine"] = (logarithm * claim_fixtures.ones(ensemble)).transpose(
        *claim_fixtures.POINT
    )


def stiffened_by_loading(ensemble):
    ensemble["g_nonaffine_loaded"] = -ensemble["g_nonaffine_loaded"]


def other_exponent(ensemble):
    ensemble["g"] = ensemble["g"] * (ensemble["phi"] - claim_fixtures.JAMMING) ** 0.5


def exponent_that_moves(ensemble):
    distance = ensemble["phi"] - claim_fixtures.JAMMING
    ensemble["g"] = ensemble["g"] * distance ** (0.1 * (ensemble["kt"] == 10.0))


MUTANTS = [
    ("G1", constant_crossing),
    ("G1", rising_crossing),
    ("G2", stiffened_by_loading),
    ("G4", other_exponent),
    ("G4", exponent_that_moves),
]


def test_they_hold_and_only_the_comparison_of_laws_is_missing():
    found = verdicts(claim_fixtures.ensemble())
    assert {n: v.verdict for n, v in found.items()} == {
        "G1": HOLDS,
        "G2": HOLDS,
        "G3": NOT_TESTED,
        "G4": HOLDS,
    }
    assert "κ* is 2.2(0) at φ = 0.86" in found["G1"].explanation
    assert "positive in 0 of 384 samples" in found["G2"].explanation


@pytest.mark.parametrize(("name", "mutate"), MUTANTS)
def test_one_changed_number_contradicts_its_claim_alone(name, mutate):
    ensemble = claim_fixtures.ensemble()
    mutate(ensemble)
    fallen = {n: v.verdict for n, v in verdicts(ensemble).items() if v.verdict != HOLDS}
    assert fallen == {name: CONTRADICTED, "G3": NOT_TESTED}


def test_the_memory_of_springs_holds_and_falls():
    assert verdicts(with_laws())["G3"].verdict == HOLDS
    for law in (KEEP_DISPLACEMENT[0], KEEP_FORCE[1]):
        ensemble = with_laws()
        name = f"comparison_pairs_sticking_{law}"
        ensemble[name] = ensemble[name] * 0.0 + 1.0 * (law in KEEP_FORCE)
        assert verdicts(ensemble)["G3"].verdict == CONTRADICTED


def test_the_sign_change_is_measured_in_the_stiffness_of_the_law():
    ensemble = claim_fixtures.ensemble()
    ensemble.attrs["config"] = json.dumps({"contact_law": {"normal": "harmonic"}})
    found = verdicts(ensemble)
    assert found["G1"].verdict == CONTRADICTED
    assert found["G1"].where.startswith("κ* / 1,")
    assert found["G4"].verdict == NOT_TESTED


def test_a_stiffness_just_below_5_is_judged_too():
    ensemble = claim_fixtures.ensemble()
    kts = ensemble["kt"].to_numpy()
    found = verdicts(ensemble.assign_coords(kt=np.where(kts == 2.0, 4.5, kts)))["G2"]
    assert "24 of 24" in found.explanation
