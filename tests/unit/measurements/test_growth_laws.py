"""Growth laws: powers of N, fits to what was timed, the rows behind them, table and figure."""

from typing import NamedTuple

import numpy as np
import pytest

from cost_fixtures import TABLE
from grainmodes.cost import GrowthLaw, read_table
from grainmodes.cost.work import work
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.parameters.strain import Shear
from measurements.benchmarks import growth, growth_laws


def test_a_law_is_a_power_of_n():
    law = GrowthLaw(2.0, 1.5, 10.0, 1.0, up_to=4096)
    assert law.seconds_at(1024) == 2.0
    assert law.seconds_at(4096) == pytest.approx(2.0 * 8)
    assert law.megabytes_at(512) == pytest.approx(5.0)


def test_every_law_of_the_table_is_used():
    every = {
        "rigidity",
        "step_strain",
        "fields",
        "claim_diagnostics",
        "shear",
        "event_detail",
        "release",
    }
    every |= {"law_comparison", "complex_pairs"}
    used = {"trajectory", "frictional_trajectory", "equilibrate", "equilibrate_with_friction"}
    used |= every
    every_state = Protocol(shear=Shear(lowest_eigenvalue="states"))
    used |= set(work("shear", "none", 64, 1.0, every_state, TABLE))
    for factorisation in ("superlu", "pardiso"):
        choices = SpectrumChoices(factorisation=factorisation)
        for kind in ("counts", "binned_averages", "eigenvalues", "modes"):
            for n in (64, 65536):
                used |= set(work("spectrum", kind, n, 1.0, Protocol(spectrum=choices), TABLE))
    assert used == set(TABLE.laws)


def test_a_fit_finds_the_power_of_the_largest_sizes():
    sizes = [64, 256, 512, 1024, 2048]
    fit = growth_laws.fit_power_law(sizes, [1e3, *(0.3 * (n / 1024) ** 1.4 for n in sizes[1:])])
    assert fit[:2] == pytest.approx((0.3, 1.4))
    assert max(fit[2:]) < 1e-9


def test_a_fit_states_its_error():
    draws = np.random.default_rng(1)
    sizes = [512, 1024, 2048, 4096]
    exact = np.array([0.3 * (n / 1024) ** 1.4 for n in sizes])
    fits = [
        growth_laws.fit_power_law(sizes, exact * np.exp(draws.normal(0, 0.1, 4)))
        for _ in range(400)
    ]
    spread = np.std([fit.p for fit in fits])
    assert np.sqrt(np.mean([fit.p_error**2 for fit in fits])) == pytest.approx(spread, rel=0.15)
    spread = np.std([np.log(fit.c) for fit in fits])
    assert np.sqrt(np.mean([fit.c_error**2 for fit in fits])) == pytest.approx(spread, rel=0.15)
    assert np.isnan(growth_laws.fit_power_law(sizes[:2], exact[:2]).p_error)


class Timed(NamedTuple):
    """What a measurement returns."""

    seconds: float
    units: float
    megabytes: float


@pytest.fixture
def timed(monkeypatch):
    """The works and sizes that are measured, each as N cubed."""
    calls = []

    def in_fresh_process(function, *arguments):
        if function != "timed":
            return {"bare": 150.0, "start_up": 0.5}[function]
        work, n, _ = arguments
        calls.append((work, n))
        units = 40.0 if work.startswith("count") else 1.0
        return Timed(2.0 * (n / 1024) ** 3, units, 150.0 + n / 50)

    monkeypatch.setattr(growth, "in_fresh_process", in_fresh_process)
    monkeypatch.setattr(growth, "find_spec", lambda name: None)
    return calls


def test_growth_measures_up_to_a_limit(timed, tmp_path):
    growth.measure(tmp_path / "growth.csv", 20.0)
    machine, rows = growth.read(tmp_path / "growth.csv")
    assert "cores" in machine
    assert rows["n"][rows["work"] == "rigidity"].tolist() == [64, 128, 256, 512, 1024, 2048]
    assert "count_pardiso" not in set(rows["work"])
    assert set(rows["work"]) == {"bare", *growth.WORKS} - {"count_pardiso", "window_pardiso"}


def test_growth_goes_on_where_it_was_stopped(timed, tmp_path):
    growth.measure(tmp_path / "growth.csv", 20.0)
    before = (tmp_path / "growth.csv").read_text()
    timed.clear()
    growth.measure(tmp_path / "growth.csv", 20.0)
    assert not timed
    growth.measure(tmp_path / "growth.csv", 200.0)
    assert (tmp_path / "growth.csv").read_text().startswith(before)
    assert set(timed) == {(work, 4096) for work in growth.WORKS if "pardiso" not in work}


def test_rows_of_another_machine_are_refused(timed, tmp_path, monkeypatch):
    growth.measure(tmp_path / "growth.csv", 1.0)
    monkeypatch.setattr(growth, "machine", lambda: "another")
    with pytest.raises(ValueError, match="measured on another machine"):
        growth.measure(tmp_path / "growth.csv", 1.0)


@pytest.mark.parametrize(
    ("seconds", "next_one"),
    [([], 0.0), ([3.0], 3.0), ([1.0, 3.0], 9.0), ([4.0, 2.0], 2.0), ([0.01, 1.0], 8.0)],
)
def test_the_next_size_is_foreseen(seconds, next_one):
    assert growth.expected(seconds) == next_one


@pytest.fixture
def rows(timed, tmp_path):
    """Rows up to N = 2048."""
    growth.measure(tmp_path / "growth.csv", 20.0)
    return growth.read(tmp_path / "growth.csv")[1]


def test_the_table_of_costs_holds_what_was_measured(rows, tmp_path):
    growth_laws.write("a machine", rows, tmp_path / "costs.yaml")
    table = read_table(tmp_path / "costs.yaml")
    assert table.machine == "a machine"
    law = table.laws["rigidity"]
    assert (law.seconds, law.exponent, law.up_to) == (2.0, 3.0, 2048)
    assert (law.megabytes, law.memory_exponent) == pytest.approx((20.48, 1.0), rel=0.01)
    assert table.laws["count_superlu"].seconds == 0.05
    assert table.laws["count_pardiso"] == TABLE.laws["count_pardiso"]
    assert table.job == {"seconds": 0.5, "megabytes": 150}
    assert (table.climb, table.disk) == (TABLE.climb, TABLE.disk)


def test_exponents_are_those_of_a_whole_sample(rows):
    time, memory = growth_laws.fit_laws(rows)["count_superlu"]
    assert (time.c, time.p) == pytest.approx((2.0 * 160 / 40, 3.0))
    assert memory.p == pytest.approx(1.0, abs=0.01)
    assert "| rigidity | 256 to 2048 | 3(0) |" in growth_laws.exponents(rows)


def test_memory_that_cannot_be_told_is_not_fitted(rows):
    few = growth_laws.per_sample(rows).query("work == 'rigidity'")
    assert few["n"][few["megabytes"].notna()].tolist() == [256, 512, 1024, 2048]
    short = rows[(rows["work"] == "bare") | (rows["n"] < 512)]
    assert growth_laws.exponent_text(growth_laws.fit_laws(short)["rigidity"][1]) == "–"


def test_every_work_has_its_place_in_the_figure(rows, tmp_path):
    from measurements.benchmarks import growth_figure

    placed = [work for works in growth_figure.PANELS.values() for work in works]
    assert sorted(placed) == sorted(growth.WORKS)
    growth_figure.write("a machine", rows, tmp_path / "growth")
    assert {path.suffix for path in tmp_path.glob("growth.*")} == {".csv", ".png", ".pdf"}
