"""The work of a spectrum, by its kind, its size and its method."""

from dataclasses import replace

import pytest

from cost_fixtures import TABLE
from grainmodes.cost.work import work
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.release import Release
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.parameters.strain import Shear

CHOICES = SpectrumChoices(factorisation="superlu", bin_density=1.0)
PROTOCOL = Protocol(spectrum=CHOICES)


@pytest.mark.parametrize(
    ("kind", "n", "method", "units"),
    [
        ("counts", 256, "auto", {"dense_values": 1}),
        ("counts", 4096, "auto", {"count_superlu": 641}),
        ("counts", 256, "inertia_counts", {"count_superlu": 641}),
        ("counts", 4096, "dense", {"dense_values": 1}),
        ("binned_averages", 256, "auto", {"dense_modes": 1}),
        ("binned_averages", 1024, "auto", {"dense_modes": 1}),
        ("binned_averages", 65536, "auto", {"count_superlu": 8 * 641, "window_superlu": 60 * 641}),
        ("binned_averages", 4096, "auto", {"count_superlu": 8 * 641, "window_superlu": 3 * 4096}),
        ("eigenvalues", 1024, "auto", {"dense_values": 1}),
        ("modes", 1024, "auto", {"dense_modes": 1}),
        ("modes", 1024, "slicing", {"window_superlu": 3 * 1024}),
        ("modes", 4096, "auto", {"window_superlu": 3 * 4096}),
        ("modes", 4096, "dense", {"dense_modes": 1}),
    ],
)
def test_a_spectrum_is_the_work_of_its_method(kind, n, method, units):
    asked = Protocol(spectrum=replace(CHOICES, method=method))
    assert work("spectrum", kind, n, 1.0, asked, TABLE) == units
    assert work("spectrum_rattlers", kind, n, 1.0, asked, TABLE) == units


def test_without_rotation_there_is_less_of_a_spectrum():
    asked = Protocol(spectrum=replace(CHOICES, method="slicing"))
    assert work("spectrum", "modes", 1024, 0.0, asked, TABLE) == {"window_superlu": 2048}
    assert work("spectrum", "counts", 4096, 0.0, asked, TABLE) == {"count_superlu": 541}


def test_two_hessians_are_counted_whatever_the_spectrum():
    assert work("spectrum_hessian", "modes", 4096, 1.0, PROTOCOL, TABLE) == {"count_superlu": 1282}


@pytest.mark.parametrize(
    ("n", "kt", "lowest", "further"),
    [
        (128, 0.0, "events", {}),
        (128, 1.0, "events", {"event_pairs": 60.0}),
        (400, 1.0, "events", {"event_pairs": 60.0}),
        (402, 1.0, "events", {}),
        (1024, 1.0, "states", {"lowest_eigenvalue": 200.0}),
    ],
)
def test_a_shear_is_priced_by_its_strain_and_what_is_computed_on_it(n, kt, lowest, further):
    protocol = Protocol(shear=Shear(0.2, 1e-3, lowest_eigenvalue=lowest))
    found = work("shear", "none", n, kt, protocol, TABLE)
    assert found == pytest.approx({"shear": 0.2 / 1e-4} | further)


@pytest.mark.parametrize(
    ("choices", "rates", "millions"),
    [
        (Release(), (), 6 * 3.0 + 0.01),
        (Release(duration=40.0, min_time=0.0, dampings=(1.0,)), (), 2 * 0.02 + 0.01),
        (Release(time_step=0.05, dampings=()), (), 6.0 + 0.02),
        (Release(duration=10.0, dampings=()), (2e-2, 2e-5), 3.0 + 5.0 + 0.005 + 5.0),
    ],
)
def test_a_release_is_priced_by_the_steps_of_its_runs(choices, rates, millions):
    protocol = Protocol(release=choices, complex_pairs=PairChoices(release_rates=rates))
    found = work("release", "none", 500, 1.0, protocol, TABLE)
    assert found == {"release": pytest.approx(millions)}
