"""C8 and C9 hold where they should, and fall, alone, where one number is changed."""

import json
import re

import numpy as np
import pytest

import claim_fixtures_laws
from grainmodes.claims import check, paper_a, paper_b, paper_c
from grainmodes.claims.claim import (
    CONTRADICTED,
    HOLDS,
    NOT_COMPARABLE,
    NOT_RESOLVED,
    NOT_TESTED,
)
from grainmodes.claims.paper_c import laws

OWN = (laws.smoothed_is_unstable, laws.sharp_is_stable)


def verdicts(ensemble, claims=OWN):
    return {verdict.claim: verdict for verdict in check(ensemble, claims)}


def never_born(ensemble):
    ensemble["comparison_pairs_slipping_smoothed_coulomb"] *= 0.0


def slower(ensemble):
    ensemble["comparison_growth_smoothed_coulomb"] *= 0.5


def held_springs_oscillate(ensemble):
    sharp = ensemble["comparison_pairs_slipping_sharp_coulomb"]
    ensemble["comparison_pairs_sticking_sharp_coulomb"] = sharp.copy()


def sharp_grows(ensemble):
    sharp = ensemble["comparison_rate_sharp_coulomb"]
    ensemble["comparison_growth_sharp_coulomb"] = 0.5 * sharp.where(sharp > 0.0)


def test_both_hold_and_name_their_numbers():
    found = verdicts(claim_fixtures_laws.ensemble())
    assert {name: v.verdict for name, v in found.items()} == {"C8": HOLDS, "C9": HOLDS}
    assert re.search(r"1\.[45]\d+\(\d\d\) pairs", found["C8"].explanation)
    assert "is 0.5(0) if springs slip; of 80 released states 0 grow" in found["C9"].explanation


@pytest.mark.parametrize(
    ("name", "mutate"),
    [
        ("C8", never_born),
        ("C8", slower),
        ("C9", held_springs_oscillate),
        ("C9", sharp_grows),
    ],
)
def test_one_changed_number_contradicts_its_claim_alone(name, mutate):
    ensemble = claim_fixtures_laws.ensemble()
    mutate(ensemble)
    found = verdicts(ensemble, (*paper_a.CLAIMS, *paper_b.CLAIMS, *paper_c.CLAIMS))
    fallen = {
        n: v.verdict
        for n, v in found.items()
        if v.verdict not in (HOLDS, NOT_TESTED, NOT_COMPARABLE)
    }
    assert fallen == {name: CONTRADICTED}


def test_single_states_that_grow_are_counted_before_they_decide():
    ensemble = claim_fixtures_laws.ensemble()
    growth = ensemble["comparison_growth_sharp_coulomb"].to_numpy()
    growth[..., :4, 1] = 0.4 * claim_fixtures_laws.RATE
    ensemble["comparison_growth_sharp_coulomb"].values = growth
    verdict = verdicts(ensemble)["C9"]
    assert verdict.verdict != HOLDS
    assert "of 80 released states 4 grow" in verdict.explanation


def test_hertzian_grains_and_other_observables_are_not_tested():
    ensemble = claim_fixtures_laws.ensemble()
    without = ensemble.drop_vars("comparison_pairs_slipping_sharp_coulomb")
    assert verdicts(without)["C9"].verdict == NOT_TESTED
    assert verdicts(without)["C8"].verdict == HOLDS
    ensemble.attrs["config"] = json.dumps({})
    assert {v.verdict for v in verdicts(ensemble).values()} == {NOT_TESTED}


def test_a_sharp_law_without_slip_is_judged_by_its_springs_alone():
    ensemble = claim_fixtures_laws.ensemble()
    for name, value in (("pairs_slipping", 0.0), ("rate", 0.0), ("growth", np.nan)):
        ensemble[f"comparison_{name}_sharp_coulomb"] *= value
    verdict = verdicts(ensemble)["C9"]
    assert verdict.verdict == HOLDS
    assert verdict.where.startswith("sticking")


def test_pairs_in_four_of_four_samples_may_be_chance():
    """A share has the interval of the binomial distribution, also where all samples agree."""
    ensemble = claim_fixtures_laws.ensemble().isel(seed=range(4))
    verdict = verdicts(ensemble)["C8"]
    assert verdict.verdict == NOT_RESOLVED
    assert "4 of 4 [0.40, 1.00]" in verdict.printed
