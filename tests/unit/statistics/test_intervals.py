"""Shares, medians and corrected tests against closed forms and numbers worked out by hand."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from grainmodes.statistics.estimates import Estimate, difference_of_means, logarithm, mean
from grainmodes.statistics.medians import Median, median, median_relative_difference
from grainmodes.statistics.multiple_tests import holm
from grainmodes.statistics.shares import Share, share


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
    values, reference = np.array([1.1, -1.1, 5.0, 1.0]), np.array([1.0, -1.0, 0.0, np.nan])
    found = median_relative_difference(values, reference)
    assert_allclose(found.ordered, (-0.1, 0.1))
    assert found.left_out == 1


def test_student_allows_for_the_error_of_the_error():
    found = Estimate(3.0, 1.0, 1)
    assert found.samples == 2
    assert found.p_at_most(0.0) == pytest.approx(0.1024, abs=1e-4)
    assert Estimate(3.0, 1.0, 7).p_at_most(0.0) == pytest.approx(0.00997, abs=1e-5)
    assert found.p_at_least(0.0) == pytest.approx(1.0 - found.p_at_most(0.0))
    assert found.interval() == pytest.approx((3.0 - 12.7062, 3.0 + 12.7062))
    exact = Estimate(3.0, 0.0, 7)
    assert (exact.p_at_most(2.0), exact.p_at_most(4.0), exact.p_at_most(3.0)) == (0.0, 1.0, 1.0)


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
