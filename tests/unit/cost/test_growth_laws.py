"""Growth laws: powers of N, fits to what was timed, and the table of both."""

from typing import NamedTuple

import numpy as np
import pytest

from benchmarks import growth
from grainmodes.cost import Law, read_table
from grainmodes.cost.work import work
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.spectra import SpectrumChoices
from priced import TABLE


def test_a_law_is_a_power_of_n():
    law = Law(2.0, 1.5, 10.0, 1.0, up_to=4096)
    assert law.seconds_at(1024) == 2.0
    assert law.seconds_at(4096) == pytest.approx(2.0 * 8)
    assert law.megabytes_at(512) == pytest.approx(5.0)


def test_every_law_of_the_table_is_used():
    every = {"rigidity", "step_strain", "fields", "probes", "shear", "close_up", "release"}
    every |= {"variants", "pairs"}
    used = {"trajectory", "pack"} | every
    for factorisation in ("superlu", "pardiso"):
        choices = SpectrumChoices(factorisation=factorisation)
        for kind in ("counts", "bands", "eigenvalues", "modes"):
            for n in (64, 65536):
                used |= set(work("spectrum", kind, n, 1.0, Protocol(spectrum=choices), TABLE))
    assert used == set(TABLE.laws)


def test_a_fit_finds_the_power_of_the_largest_sizes():
    sizes = [64, 256, 512, 1024, 2048]
    fit = growth.fitted(sizes, [1e3, *(0.3 * (n / 1024) ** 1.4 for n in sizes[1:])])
    assert fit[:2] == pytest.approx((0.3, 1.4))
    assert max(fit[2:]) < 1e-9


def test_a_fit_states_its_error():
    draws = np.random.default_rng(1)
    sizes = [512, 1024, 2048, 4096]
    exact = np.array([0.3 * (n / 1024) ** 1.4 for n in sizes])
    fits = [growth.fitted(sizes, exact * np.exp(draws.normal(0, 0.1, 4))) for _ in range(400)]
    spread = np.std([fit.p for fit in fits])
    assert np.sqrt(np.mean([fit.p_error**2 for fit in fits])) == pytest.approx(spread, rel=0.15)
    spread = np.std([np.log(fit.c) for fit in fits])
    assert np.sqrt(np.mean([fit.c_error**2 for fit in fits])) == pytest.approx(spread, rel=0.15)
    assert np.isnan(growth.fitted(sizes[:2], exact[:2]).p_error)


class Timed(NamedTuple):
    """What a measurement returns."""

    seconds: float
    units: float
    megabytes: float


def test_growth_writes_a_table_and_stops_in_time(monkeypatch, tmp_path):
    asked = []

    def apart(function, *arguments):
        if function != "timed":
            return {"bare": 150.0, "start_up": 0.5, "climb": [3.0, 1.0] + [0.0] * 9}[function]
        work, n, _ = arguments
        asked.append((work, n))
        units = 4.0 if work == "count_superlu" else 1.0
        return Timed(2.0 * (n / 1024) ** 3, units, 150.0 + n / 100)

    monkeypatch.setattr(growth, "apart", apart)
    monkeypatch.setattr(growth, "find_spec", lambda name: None)
    growth.main(tmp_path / "costs.yaml")
    table = read_table(tmp_path / "costs.yaml")
    assert table.laws["rigidity"] == Law(2.0, 3.0, 10.2, 1.0, 2048)
    assert table.laws["count_superlu"].seconds == 0.5
    assert table.laws["count_pardiso"] == TABLE.laws["count_pardiso"]
    assert max(n for _, n in asked) == 2048
    assert table.job == {"seconds": 0.5, "megabytes": 150}
    assert table.share(0.80) == 0.75
    assert table.disk == TABLE.disk
