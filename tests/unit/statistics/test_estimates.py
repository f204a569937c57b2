"""Numbers with standard errors over samples: the jackknife, paired differences, crossings."""

import numpy as np
import pytest

from grainmodes.statistics.estimates import (
    Estimate,
    crossing,
    jackknife,
    mean,
    relative_difference,
)


def test_an_estimate_is_printed_with_its_error():
    assert f"{Estimate(0.4998712, 0.000297, 7)}" == "0.49987(30)"


def test_the_jackknife_of_a_mean_is_its_standard_error():
    values = np.random.default_rng(3).normal(size=7)
    assert jackknife(np.mean, values) == pytest.approx(mean(values))
    assert mean(values).error == pytest.approx(values.std(ddof=1) / 7**0.5)


def test_infinite_values_are_left_out_of_a_mean_and_counted():
    found = mean(np.array([1.0, 3.0, -np.inf, np.nan]))
    assert found == Estimate(2.0, 1.0, 1, left_out=1)


def test_what_packings_share_drops_out_of_a_paired_difference():
    reference = np.random.default_rng(4).normal(5.0, 2.0, 8)
    found = relative_difference(1.02 * reference, reference)
    assert found[:3] == pytest.approx((0.02, 0.0, 7), abs=1e-12)


def test_a_crossing_is_found_between_the_points_of_the_grid():
    kappas = np.array([1e-2, 1.0, 2.0, 10.0])
    rows = np.log(kappas / 3.0) * np.array([[0.9], [1.0], [1.1]])
    assert crossing(kappas, rows)[:2] == pytest.approx((3.0, 0.0), abs=1e-9)
    assert crossing(kappas[:3], rows[:, :3])[:2] == pytest.approx((2.0, 0.0))
    assert crossing(kappas[3:], rows[:, 3:])[:2] == pytest.approx((10.0, 0.0))
