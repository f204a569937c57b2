"""Claims: every one holds where it should, and falls, alone, where one number is doctored."""

import csv

import numpy as np
import pytest

import claimed
from grainmodes.claims import check, report
from grainmodes.claims.claim import (
    CONTRADICTED,
    HOLDS,
    NOT_ASKED,
    NOT_RESOLVED,
    Outcome,
    Part,
    claim,
)
from grainmodes.claims.estimates import Estimate, crossing, jackknife, mean, relative_difference
from grainmodes.claims.paper_a import CLAIMS
from grainmodes.cli import main

NAMES = [f"A{number}" for number in range(1, 20)]
LARGEST = {"n": claimed.NS[-1], "phi": 0.90}


def verdicts(ensemble):
    return {verdict.claim: verdict for verdict in check(ensemble, CLAIMS)}


def theory_off(ensemble):
    ensemble["g_simulated"] = 1.05 * ensemble["g_simulated"]


def proportional(ensemble):
    distance, kt = ensemble["phi"] - claimed.JAMMING, ensemble["kt"]
    much = kt / (1 + kt)
    g = distance**1.5 * (1 - much) + distance * 0.3 * much
    claimed.set_moduli(ensemble, g.where(kt < 0.5, distance) * claimed._ones(ensemble))


def not_flat(ensemble):
    step = 1.0 + 0.05 * (ensemble["kt"] == 1e-4)
    claimed.set_moduli(ensemble, without_noise(ensemble) * step)


def jump(ensemble):
    step = 1.0 + 0.05 * (ensemble["kt"] > 0)
    claimed.set_moduli(ensemble, without_noise(ensemble) * step)


def product(ensemble):
    distance, kt = ensemble["phi"] - claimed.JAMMING, ensemble["kt"]
    claimed.set_moduli(ensemble, distance**0.5 * (1 + kt) * claimed._ones(ensemble))


def without_noise(ensemble):
    return ensemble["g"] / claimed._noise(ensemble, 0.05)


def crossing_at_four(ensemble):
    logarithm = np.log(ensemble["kt"].clip(1e-12) / 4.0)
    shifted = (ensemble["phi"] - claimed.JAMMING) * logarithm * claimed._noise(ensemble, 0.05)
    ensemble["g_nonaffine"] = (shifted * claimed._ones(ensemble)).transpose(*claimed.POINT)


def mixed_modes(ensemble):
    psi = ensemble["psi_rotational"]
    small = (ensemble["kt"] > 0) & (ensemble["kt"] < 1e-3)
    ensemble["psi_rotational"] = psi.where(~(small & (psi > 0.5)), 0.75)


def sound_in_the_band(ensemble):
    eigenvalue = ensemble["eigenvalue"]
    sound = abs(eigenvalue / claimed.SOUND**2 - 1.0) < 1e-6
    low = (ensemble["kt"] > 0) & (ensemble["kt"] <= 1e-8)
    ensemble["eigenvalue"] = eigenvalue.where(~(sound & low), ensemble["kt"])
    claimed.count_hessian(ensemble)


def peak_elsewhere(ensemble):
    rotational = ensemble["psi_rotational"] > 0.5
    ensemble["eigenvalue"] = ensemble["eigenvalue"].where(
        ~rotational, ensemble["eigenvalue"] * 0.4**2
    )
    claimed.count_hessian(ensemble)


def fewer_rotations(ensemble):
    psi, x = ensemble["psi_rotational"], np.sqrt(ensemble["eigenvalue"] / ensemble["kt"])
    upper = (ensemble["kt"] == 1e-2) & (psi > 0.5) & (x > 1.2)
    ensemble["psi_rotational"] = psi.where(~upper, 0.45)


def other_frictionless(ensemble):
    ensemble["eigenvalue"].loc[{"kt": 0.0}] *= 1.21
    claimed.count_hessian(ensemble)


def other_hessian(ensemble):
    ensemble["bin_count_hessian"] = ensemble["bin_count_hessian_printed"]


def spread_rattlers(ensemble):
    ensemble["participation_ratio_rattlers"][..., -2:] *= 10.0


def size_matters(ensemble):
    place = {"n": claimed.NS[0], "kt": 1e-8}
    translational = ensemble["psi_rotational"].loc[place] <= 0.5
    values = ensemble["eigenvalue"].loc[place]
    ensemble["eigenvalue"].loc[place] = values.where(~translational, values * 1.44)


def no_way_down(ensemble):
    reference = ensemble["eigenvalue"].sel(phi=0.90)
    ensemble["eigenvalue"] = (reference + 0 * ensemble["phi"]).transpose(*claimed.POINT, "mode")
    ensemble["eigenvalue"].loc[{"phi": 0.86}] *= 1.1
    claimed.count_hessian(ensemble)


def strain_matters(ensemble):
    ensemble["g_forward_by_strain"][..., -1] *= 1.05


def rotations_needed(ensemble):
    ensemble["g_translational"] = 0.9 * ensemble["g_translational"]


def other_order(ensemble):
    ensemble["verlet_order_velocity"] = 2.0 * ensemble["verlet_order_velocity"]


def no_pairs(ensemble):
    ensemble["complex_pairs_frictional"] = 0.0 * ensemble["complex_pairs_frictional"]


DOCTORED = {
    "A1": theory_off,
    "A2": proportional,
    "A3": not_flat,
    "A4": jump,
    "A5": product,
    "A6": crossing_at_four,
    "A7": mixed_modes,
    "A8": sound_in_the_band,
    "A9": peak_elsewhere,
    "A10": fewer_rotations,
    "A11": other_frictionless,
    "A12": other_hessian,
    "A13": spread_rattlers,
    "A14": size_matters,
    "A15": no_way_down,
    "A16": strain_matters,
    "A17": rotations_needed,
    "A18": other_order,
    "A19": no_pairs,
}


def no_growth(ensemble):
    ensemble["g_nonaffine"] = ensemble["g_nonaffine"] / (ensemble["phi"] - claimed.JAMMING)


def never_overlapping(ensemble):
    values = ensemble["eigenvalue"]
    sound = abs(values / claimed.SOUND**2 - 1.0) < 1e-6
    ensemble["eigenvalue"] = values.where(~sound, values * 3e4)
    claimed.count_hessian(ensemble)


def no_collapse(ensemble):
    values, psi = ensemble["eigenvalue"], ensemble["psi_rotational"]
    one = (ensemble["kt"] == 1e-6) & (psi > 0.5)
    ensemble["eigenvalue"] = values.where(~one, values * 0.6)
    claimed.count_hessian(ensemble)


def other_position_order(ensemble):
    ensemble["verlet_order_position"] = 0.5 * ensemble["verlet_order_position"]


SECOND = {
    "A6": no_growth,
    "A8": never_overlapping,
    "A9": no_collapse,
    "A18": other_position_order,
}
"""Claims that say two things, doctored in the second."""


def test_every_claim_holds_where_it_should():
    found = verdicts(claimed.ensemble())
    assert list(found) == NAMES
    assert {name: v.verdict for name, v in found.items() if v.verdict != HOLDS} == {}
    assert all(np.isfinite([v.measured, v.uncertainty]).all() for v in found.values())


@pytest.mark.parametrize(("name", "doctor"), [*DOCTORED.items(), *SECOND.items()])
def test_one_doctored_number_contradicts_its_claim_alone(name, doctor):
    ensemble = claimed.ensemble()
    doctor(ensemble)
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
    "A19": "jammed_frictional",
}


@pytest.mark.parametrize("name", NAMES)
def test_what_the_ensemble_lacks_is_not_asked_and_named(name):
    found = verdicts(claimed.ensemble().drop_vars(NEEDED[name]))
    assert found[name].verdict == NOT_ASKED
    assert NEEDED[name] in found[name].explanation
    others = {n: v.verdict for n, v in found.items() if NEEDED[name] not in v.explanation}
    assert set(others.values()) == {HOLDS}


@pytest.mark.parametrize(
    ("grid", "names", "lack"),
    [
        ({"kt": [1e-8, 1e-4, 2.0]}, ("A4", "A5", "A11"), "k_T = 0"),
        ({"kt": [0.0, 1e-10, 1e-8]}, ("A6", "A8"), "k_T/k_N"),
        ({"phi": [0.90]}, ("A2", "A5", "A6", "A15"), "area fractions"),
        ({"n": [64]}, ("A14",), "two N"),
    ],
)
def test_points_that_the_grid_lacks_are_named(grid, names, lack):
    found = verdicts(claimed.ensemble().sel(grid))
    for name in names:
        assert found[name].verdict == NOT_ASKED
        assert lack in found[name].explanation


@pytest.mark.parametrize(
    "grid", [{"kt": [0.0]}, {"kt": [10.0]}, {"phi": [0.90], "kt": [1e-8]}, {"seed": [0]}]
)
def test_an_ensemble_of_few_points_has_no_verdict_against_a_claim(grid):
    found = check(claimed.ensemble().sel(grid), CLAIMS)
    assert [verdict.claim for verdict in found] == NAMES
    assert CONTRADICTED not in {verdict.verdict for verdict in found}


def test_points_that_were_not_computed_change_no_verdict():
    ensemble = claimed.ensemble()
    larger = ensemble.reindex(n=[32, 64, 128], phi=[0.86, 0.87, 0.88, 0.90])
    assert {v.verdict for v in check(larger, CLAIMS)} == {HOLDS}


def test_failed_and_unjammed_samples_are_left_out():
    ensemble = claimed.ensemble()
    ensemble["g_simulated"][..., 0] *= 3.0
    ensemble["converged"][..., 0] = 0.0
    ensemble["g_simulated"][..., 1] = 7.0
    ensemble["jammed"][..., 1] = 0.0
    assert verdicts(ensemble)["A1"].verdict == HOLDS


def test_bins_give_the_verdicts_of_the_modes():
    by_mode, by_bin = claimed.ensemble(), claimed.bins_of(claimed.ensemble())
    for name in ("A7", "A8", "A9", "A10", "A11", "A14", "A15"):
        modes, bins = verdicts(by_mode)[name], verdicts(by_bin)[name]
        assert bins.verdict == modes.verdict == HOLDS
        assert bins.measured == pytest.approx(modes.measured, abs=0.03)


def test_the_loaded_step_stands_beside_the_sign_change():
    verdict = verdicts(claimed.ensemble())["A6"]
    assert "positive in 0 of 144 samples" in verdict.explanation
    assert "2 ± " in verdict.explanation


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
    assert "2 of 3 are contradicted: worse" in verdict.explanation


def test_the_jackknife_of_a_mean_is_its_standard_error():
    values = np.random.default_rng(3).normal(size=7)
    assert jackknife(np.mean, values) == pytest.approx(mean(values))
    assert mean(values).error == pytest.approx(values.std(ddof=1) / 7**0.5)


def test_what_packings_share_drops_out_of_a_paired_difference():
    reference = np.random.default_rng(4).normal(5.0, 2.0, 8)
    assert relative_difference(1.02 * reference, reference) == pytest.approx((0.02, 0.0), abs=1e-12)


def test_a_crossing_is_found_between_the_points_of_the_grid():
    kappas = np.array([1e-2, 1.0, 2.0, 10.0])
    rows = np.log(kappas / 3.0) * np.array([[0.9], [1.0], [1.1]])
    assert crossing(kappas, rows) == pytest.approx((3.0, 0.0), abs=1e-9)
    assert crossing(kappas[:3], rows[:, :3]) == pytest.approx((2.0, 0.0))
    assert crossing(kappas[3:], rows[:, 3:]) == pytest.approx((10.0, 0.0))


def test_a_sign_that_never_changes_contradicts_the_sign_change():
    ensemble = claimed.ensemble()
    ensemble["g_nonaffine"] = -0.01 - np.abs(ensemble["g_nonaffine"])
    verdict = verdicts(ensemble)["A6"]
    assert (verdict.verdict, verdict.measured) == (CONTRADICTED, 10.0)


def test_reports_hold_every_claim(tmp_path):
    found = check(claimed.ensemble().drop_vars("g_simulated"), CLAIMS)
    for suffix in report.FORMS:
        report.write(found, tmp_path / f"claims{suffix}")
    with open(tmp_path / "claims.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    page = (tmp_path / "claims.md").read_text(encoding="utf-8")
    assert [row["claim"] for row in rows] == NAMES
    assert float(rows[1]["measured"]) == found[1].measured
    assert all(f"| {name} |" in page and f"**{name}, " in page for name in NAMES)
    table = [line.replace("\\|", "") for line in page.splitlines() if line.startswith("|")]
    assert {line.count("|") for line in table} == {6}
    assert "18 holds" in report.as_text(found)
    assert "1 not asked" in report.as_text(found)


def test_the_command_prints_writes_and_refuses(tmp_path, capsys):
    path = tmp_path / "ensemble.nc"
    claimed.ensemble().assign_coords(mode=np.arange(192)).to_netcdf(path)
    assert main(["claims", str(path)]) == 0
    assert capsys.readouterr().out.startswith("A1   holds")
    assert main(["claims", str(path), "-o", str(tmp_path / "a.md"), str(tmp_path / "a.csv")]) == 0
    assert (tmp_path / "a.md").is_file() and (tmp_path / "a.csv").is_file()
    assert main(["claims", str(path), "-o", str(tmp_path / "a.txt")]) == 1
    assert "allowed are .md, .csv" in capsys.readouterr().err
    assert main(["claims", str(tmp_path / "none.nc")]) == 1
    assert "no such file" in capsys.readouterr().err
