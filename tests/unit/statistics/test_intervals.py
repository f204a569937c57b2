"""Shares, medians and corrected tests against closed forms and numbers worked out by hand."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from grainmodes.statistics.estimates import (
    Estimate,
    difference_of_means,
    log_relative_difference,
    logarithm,
    mean,
)
from grainmodes.statistics.medians import Median, median
from grainmodes.statistics.multiple_tests import holm
from grainmodes.statistics.shares import PooledShare, Share, pooled_share, share


def test_four_of_four_reach_down_to_forty_per_cent():
    assert Share(4, 4).interval() == pytest.approx((0.025**0.25, 1.0))
    assert str(Share(4, 4)) == "4 of 4 [0.40, 1.00]"
    assert Share(0, 0).interval() == (0.0, 1.0) and np.isnan(Share(0, 0).value)


@pytest.mark.parametrize("having", [0, 1, 5, 9, 10])
def test_the_tests_of_a_share_end_where_its_interval_does(having):
    found = Share(having, 10)
    low, high = found.interval(0.9)
    assert having == 0 or found.p_at_most(low) == pytest.approx(0.05)
    assert having == 10 or found.p_at_least(high) == pytest.approx(0.05)


def test_flags_of_samples_become_a_share():
    assert share(np.array([1.0, 0.0, np.nan, 1.0])) == Share(2, 3)


def test_events_of_few_samples_are_fewer_independent_ones():
    """Of four samples with 20 events each that agree, (1.96/3.18)² of 80 are left at 95 %."""
    found = pooled_share([np.ones(20)] * 4)
    assert found == PooledShare(80, 80, 4)
    events = 80 * (stats.norm.ppf(0.025) / stats.t.ppf(0.025, 3)) ** 2
    assert found.interval() == pytest.approx((0.025 ** (1.0 / events), 1.0))
    assert found.p_at_least(0.9) == 1.0
    assert str(found) == "80 of 80 events in 4 samples [0.89, 1.00]"


@pytest.mark.parametrize(("having", "samples"), [(79, 4), (80, 4), (70, 8), (40, 20)])
def test_the_tests_of_a_share_of_events_end_where_its_interval_does(having, samples):
    found = PooledShare(having, 80, samples, 1.7)
    low, high = found.interval(0.9)
    assert found.p_at_most(low) == pytest.approx(0.05)
    assert having == 80 or found.p_at_least(high) == pytest.approx(0.05)


def test_samples_that_differ_count_for_less_than_their_events():
    """All or none in each of ten samples: ten events, and not 200."""
    found = pooled_share([np.full(20, flag) for flag in (0.0,) * 5 + (1.0,) * 5])
    assert (found.value, found.samples) == (0.5, 10)
    assert found.design_effect == pytest.approx(20.0 * 10 / 9)


def test_a_share_of_events_has_the_samples_that_have_some():
    rows = [np.array([1.0, np.nan, 0.0]), np.full(3, np.nan), np.array([]), np.array([1.0])]
    assert pooled_share(rows)[:3] == (2, 3, 2)
    assert np.isnan(pooled_share([]).value)
    one = pooled_share([np.array([1.0, 0.0])])
    assert np.isnan(one.p_at_most(0.5)) and one.interval() == (0.0, 1.0)


def test_the_interval_of_a_median_ends_at_sorted_samples():
    found = median(np.array([5.0, -1e9, 3.0, np.nan, 4.0, 1.0, 2.0]))
    assert (found.value, found.samples) == (2.5, 6)
    assert found.interval() == (-1e9, 5.0)
    assert Median(tuple(range(8))).interval() == (0, 7)
    assert Median(tuple(range(9))).interval() == (1, 7)
    assert Median(tuple(range(5))).interval() == (-np.inf, np.inf)


def test_the_tests_of_a_median_count_samples_beyond_the_limit():
    found = Median((-np.inf, 1.0, 2.0, 2.0, 3.0))
    assert found.p_at_most(1.5) == stats.binom.sf(2, 5, 0.5)
    assert found.p_at_most(2.0) == stats.binom.sf(0, 5, 0.5)
    assert found.p_at_least(2.0) == stats.binom.sf(1, 5, 0.5)


def test_a_ratio_of_single_samples_may_have_a_negative_or_no_reference():
    values, reference = np.array([1.1, -1.001, 5.0, 1.0]), np.array([1.0, -1.0, 0.0, np.nan])
    found = log_relative_difference(values, reference)
    assert found.value == pytest.approx(-2.0)
    assert (found.samples, found.left_out) == (2, 1)
    assert log_relative_difference(np.array([1e6, -1e6]), np.ones(2)).value == 0.0


def test_equal_numbers_differ_by_round_off():
    found = log_relative_difference(np.ones(5), np.ones(5))
    assert (found.value, found.samples) == (-16.0, 5)


def test_student_allows_for_the_error_of_the_error():
    found = Estimate(3.0, 1.0, 1)
    assert found.samples == 2
    assert found.p_at_most(0.0) == pytest.approx(0.1024, abs=1e-4)
    assert Estimate(3.0, 1.0, 7).p_at_most(0.0) == pytest.approx(0.00997, abs=1e-5)
    assert found.p_at_least(0.0) == pytest.approx(1.0 - found.p_at_most(0.0))
    assert found.interval() == pytest.approx((3.0 - 12.7062, 3.0 + 12.7062))


def test_samples_that_agree_exactly_are_judged_by_the_sign_test():
    exact = Estimate(3.0, 0.0, 7)
    found = [exact.p_at_most(limit) for limit in (2.0, 4.0, 3.0)]
    assert found == [0.5**8, 1.0, 1.0] == [exact.p_at_least(limit) for limit in (4.0, 2.0, 3.0)]
    assert exact.samples_above(2.0, 0.02) == 6 and exact.samples_above(3.0, 0.02) == np.inf


def test_the_difference_of_unpaired_means_is_welchs():
    first, second = (np.random.default_rng(k).normal(size=n) for k, n in ((1, 5), (2, 9)))
    found = difference_of_means(first, second)
    welch = stats.ttest_ind(second, first, equal_var=False, alternative="greater")
    assert found.p_at_most(0.0) == pytest.approx(welch.pvalue)
    assert difference_of_means(np.ones(4), np.ones(6)) == (0.0, 0.0, 3.0, 0)


def test_what_a_logarithm_drops_is_counted():
    logarithms, dropped = logarithm(np.array([np.e, 0.0, -1.0, np.nan]))
    assert_allclose(logarithms, [1.0, np.nan, np.nan, np.nan])
    assert dropped == 2
    assert mean(logarithms).samples == 1


def test_holm_by_hand():
    assert_allclose(holm(np.array([0.03, 0.01, 0.04, 0.005])), [0.06, 0.03, 0.06, 0.02])
    assert_allclose(holm(np.array([0.5, 0.9])), [1.0, 1.0])
    assert holm(np.array([])).shape == (0,)
