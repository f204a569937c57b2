"""How many seeds an accuracy needs: the statistics, the plans of a point, the command."""

import re

import numpy as np
import pytest
from scipy.stats import chi2

import synthetic
from grainmodes.cli import main
from grainmodes.cost import read_table
from grainmodes.dataset.files import BlockError
from grainmodes.ensemble import open_ensemble
from grainmodes.parameters.protocol import Protocol
from grainmodes.planning import Plan, plan_point, report, seeds_needed
from grainmodes.planning.hours import preparation_of, seconds_per_seed
from grainmodes.planning.quantities import MIN_MODES

STAGES = ("packings", "rigidity", "spectrum_bins")
DENSE = (64, 0.9, 1e-4)


def spread(mean: float, deviation: float, size: int) -> np.ndarray:
    """Samples with exactly this mean and this standard deviation."""
    draws = np.random.default_rng(0).standard_normal(size)
    return mean + deviation * (draws - draws.mean()) / draws.std(ddof=1)


def pilot(folder, **changes):
    """An ensemble of one point, its blocks changed: stage → variables."""
    paths = []
    for stage in changes.get("stages", STAGES):
        block = synthetic.block(stage, *DENSE, range(8), **changes.get(stage, {}))
        paths.append(folder / f"{stage}.nc")
        synthetic.write_block(paths[-1], block)
    synthetic.write_block(folder / "point.nc", synthetic.gather_point(paths))
    synthetic.write_ensemble([folder / "point.nc"], folder / "pilot.nc", {})
    return folder / "pilot.nc"


def plans(path, target=0.01):
    """Name → plan of the point, and the remarks."""
    with open_ensemble(path) as opened:
        found = plan_point(opened, DENSE, target)
    named = {plan.quantity: plan for plan in found if isinstance(plan, Plan)}
    return named, [remark.sentence for remark in found if not isinstance(remark, Plan)]


def test_seeds_follow_from_spread_and_target():
    need = seeds_needed(spread(2.0, 0.2, 8), 0.01)
    assert need.seeds == 100
    assert need.error == pytest.approx(0.1 / 8**0.5)
    assert seeds_needed(spread(-2.0, 0.2, 8), 0.005).seeds == 400
    assert seeds_needed(spread(2.0, 0.2, 8), 0.5).seeds == 2


def test_the_interval_is_that_of_a_variance():
    need = seeds_needed(spread(2.0, 0.2, 8), 0.001)
    assert need.low == np.ceil(1e4 * 7 / chi2.ppf(0.975, 7))
    assert need.high == np.ceil(1e4 * 7 / chi2.ppf(0.025, 7))


def test_every_column_is_planned_separately():
    one, other = spread(2.0, 0.2, 8), spread(1.0, 0.3, 8)
    both = seeds_needed(np.stack([one, other], axis=1), 0.01)
    assert both.seeds.tolist() == [100, 900]
    assert both.high[1] == seeds_needed(other, 0.01).high


@pytest.mark.parametrize("size", [3, 8, 30])
def test_the_interval_contains_the_number_of_seeds_as_often_as_stated(size):
    draws = np.random.default_rng(size)
    need = seeds_needed(draws.normal(1.0, 0.05, (size, 4000)), 1e-4)
    true = 0.05**2 / 1e-8
    covered = np.mean((need.low <= true) & (need.high >= true))
    assert covered == pytest.approx(0.95, abs=0.012)


def test_as_many_seeds_as_planned_reach_the_target():
    draws = np.random.default_rng(3)
    seeds = int(seeds_needed(spread(1.0, 0.1, 8), 0.02).seeds)
    means = draws.normal(1.0, 0.1, (4000, seeds)).mean(axis=1)
    assert means.std() == pytest.approx(0.02, rel=0.05)


def test_g_is_planned_from_its_converged_seeds(tmp_path):
    g = spread(1e-2, 1e-3, 8)
    g[0], converged = 1e3, np.array([0, *[1] * 7])
    named, _ = plans(pilot(tmp_path, rigidity={"g": g, "converged": converged}))
    assert named["G"].samples == 7
    assert named["G"].need.seeds == seeds_needed(g[1:], 0.01).seeds


def test_the_bin_that_needs_most_seeds_determines_the_plan(tmp_path):
    """Two bins with enough modes, one of them with twice the spread of the other."""
    count = np.zeros((8, len(synthetic.edges(1e-4)) - 1))
    count[:, 5] = [90, 110] * 4
    count[:, 9] = [80, 120] * 4
    named, left = plans(pilot(tmp_path, spectrum_bins={"bin_count": count}))
    worst, median = named["D, worst bin"], named["D, median bin"]
    assert worst.bin == tuple(synthetic.edges(1e-4)[9:11])
    assert median.bin == tuple(synthetic.edges(1e-4)[5:7])
    assert worst.need.seeds == seeds_needed(count[:, 9], 0.01).seeds
    assert worst.spectrum == "binned_averages"
    assert "48 of 50 bins" in left[0]


def test_bins_with_few_modes_are_listed(tmp_path):
    edges = synthetic.edges(1e-4)
    count = np.full((8, len(edges) - 1), 100)
    count[:, [3, 4, 7]] = 0
    count[0, [3, 4]], count[0, 7] = MIN_MODES - 1, MIN_MODES - 1
    count[:, 8] = [MIN_MODES // 8, MIN_MODES // 8 + 1] * 4
    assert count[:, 8].sum() == MIN_MODES
    _, (sentence,) = plans(pilot(tmp_path, spectrum_bins={"bin_count": count}))
    ranges = [f"{edges[a]:.3g}–{edges[b]:.3g}" for a, b in ((3, 5), (7, 8))]
    assert sentence.endswith(f"fewer than {MIN_MODES} modes: omega t_0 in {', '.join(ranges)}")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"rigidity": {"converged": np.array([1, *[0] * 7])}},
            "expected at least 2 converged seeds for a spread, got 1",
        ),
        ({"packings": {"jammed": np.zeros(8, np.int8)}}, "no converged seed is jammed"),
        ({"rigidity": {"g": np.array([1.0, -1.0] * 4)}}, "G: the mean is 0"),
        ({"rigidity": {"g": np.array([1.0, *[np.nan] * 7])}}, "G: the spread .* got 1"),
        ({"rigidity": {"g": np.full(8, np.nan)}}, "G: the spread .* got 0"),
        ({"spectrum_bins": {"bin_count": np.zeros((8, 50))}}, "D: no bin of two samples"),
        ({"stages": STAGES[:2]}, "holds no spectra"),
        ({"stages": (STAGES[0], STAGES[2])}, "holds no g"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_what_cannot_be_planned_has_a_remark(tmp_path, changes, words):
    _, left = plans(pilot(tmp_path, **changes))
    assert any(re.search(words, sentence) for sentence in left)


@pytest.mark.parametrize(("deviation", "warnings"), [(0.9, 0), (1.0, 1)])
def test_a_mean_that_is_known_only_roughly_has_a_warning(tmp_path, deviation, warnings):
    count = np.full((8, len(synthetic.edges(1e-4)) - 1), 100)
    stages = {"rigidity": {"g": spread(1.0, deviation, 8)}, "spectrum_bins": {"bin_count": count}}
    _, left = plans(pilot(tmp_path, **stages))
    warning = "G: the pilot determines its mean only to 35%, and the number of seeds even less well"
    assert left == [warning][:warnings]


def test_an_ensemble_without_any_observable_is_refused(tmp_path, capsys):
    path = pilot(tmp_path, stages=("packings", "step_strain"))
    with pytest.raises(BlockError, match="holds no g"):
        plans(path)
    assert main(["plan", str(path), "--target-error", "1%"]) == 1
    assert "holds no g" in capsys.readouterr().err


def test_hours_are_those_of_the_stages():
    table = read_table()
    rigidity = seconds_per_seed((1024, 0.9, 1e-4), "none", "frictionless", Protocol(), table)
    laws = table.laws
    parts = (laws[name].seconds for name in ("trajectory", "equilibrate", "rigidity"))
    assert rigidity == pytest.approx(sum(parts))
    modes = seconds_per_seed((1024, 0.9, 1e-4), "modes", "frictionless", Protocol(), table)
    assert modes - rigidity == pytest.approx(laws["dense_modes"].seconds - laws["rigidity"].seconds)
    lower = seconds_per_seed((1024, 0.83, 1e-4), "none", "frictionless", Protocol(), table)
    assert rigidity - lower == pytest.approx((1 - table.share(0.83)) * laws["trajectory"].seconds)


@pytest.mark.parametrize(
    ("flag", "preparation", "laws"),
    [
        (0.0, "frictionless", ("trajectory", "equilibrate")),
        (1.0, "frictional", ("frictional_trajectory", "equilibrate_with_friction")),
    ],
)
def test_a_pilot_is_priced_as_its_packings_were_compressed(tmp_path, flag, preparation, laws):
    table = read_table()
    path = synthetic.ensemble(tmp_path, ns=(1024,), phis=(0.9,), kts=(1.0,), seeds=8)
    with open_ensemble(path) as pilot:
        assert preparation_of(pilot, (1024, 0.9, 1.0)) == "frictionless"
        marked = pilot.assign(compressed_with_friction=flag + 0.0 * pilot["converged"])
        assert preparation_of(marked, (1024, 0.9, 1.0)) == preparation
        row = next(line for line in report(marked, 0.01, table).splitlines() if " G " in line)
    seconds = seconds_per_seed((1024, 0.9, 1.0), "none", preparation, Protocol(), table)
    assert seconds == pytest.approx(sum(table.laws[name].seconds for name in (*laws, "rigidity")))
    assert float(row[84:93]) == pytest.approx(float(row[52:62]) * seconds / 3600, rel=0.01)


def test_the_command_prints_a_row_for_every_quantity(tmp_path, capsys):
    path = synthetic.ensemble(tmp_path, ns=(64,), phis=(0.83, 0.9), kts=(1.0,), seeds=8)
    for target in ("2%", "0.02"):
        assert main(["plan", str(path), "--target-error", target]) == 0
        printed = capsys.readouterr().out
        assert "relative standard error of 2 %" in printed
        rows = [line for line in printed.splitlines() if line.startswith("    64     0.9")]
        assert [row[24:38].strip() for row in rows] == ["G", "D, median bin", "D, worst bin"]
        seeds, hours = (float(rows[0][place]) for place in (slice(52, 62), slice(84, 93)))
        seconds = seconds_per_seed((64, 0.9, 1.0), "none", "frictionless", Protocol(), read_table())
        assert hours == pytest.approx(seeds * seconds / 3600, rel=0.01)
        assert "n = 64, phi = 0.83, k_T = 1: no converged seed is jammed" in printed


@pytest.mark.parametrize("target", ["0", "1", "100%", "-1%", "1%%", "one", "nan"])
def test_a_target_lies_between_0_and_1(target, capsys):
    with pytest.raises(SystemExit):
        main(["plan", "pilot.nc", f"--target-error={target}"])
    assert "expected a fraction between 0 and 1, such as 1% or 0.01" in capsys.readouterr().err


def test_a_pilot_that_allows_no_plan_is_refused(tmp_path, capsys):
    path = synthetic.ensemble(tmp_path, phis=(0.83,), kts=(1.0,), seeds=8)
    assert main(["plan", str(path), "--target-error", "1%"]) == 1
    assert f"{path}: expected a point with at least 2 converged seeds" in capsys.readouterr().err
