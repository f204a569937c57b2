"""Averages and bins against numbers worked out by hand."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from grainmodes.statistics import averages, binning


def test_average_of_three_samples_by_hand():
    result = averages.average(np.array([1.0, 2.0, 6.0]), np.ones(3, bool))
    assert result.mean == 3.0
    assert_allclose(result.standard_error, np.sqrt((4 + 1 + 9) / (3 * 2)))
    assert result.samples == 3


def test_average_leaves_out_samples_not_used_and_missing_values():
    values = np.array([[1.0, 3.0, 100.0, np.nan]])
    result = averages.average(values, np.array([[True, True, False, True]]))
    assert_array_equal(result.mean, [2.0])
    assert_array_equal(result.standard_error, [1.0])
    assert_array_equal(result.samples, [2])


def test_average_of_one_sample_has_no_error_and_of_none_no_mean():
    result = averages.average(np.array([[5.0], [5.0]]), np.array([[True], [False]]))
    assert_array_equal(result.mean, [5.0, np.nan])
    assert_array_equal(result.standard_error, [np.nan, np.nan])
    assert_array_equal(result.samples, [1, 0])


def test_the_two_translations_go_and_soft_rotations_stay():
    eigenvalue = np.array([[-3e-17, 2e-16, 1e-9, 4.0]])
    result = averages.frequencies(eigenvalue)
    assert_allclose(result.frequency, [[np.nan, np.nan, np.sqrt(1e-9), 2.0]])
    assert (result.zero, result.negative) == (2, 0)


def test_translations_go_even_where_round_off_lifts_them_above_the_floor():
    result = averages.frequencies(np.array([[3e-13, -2e-13, 0.25, 1.0]]))
    assert_allclose(result.frequency, [[np.nan, np.nan, 0.5, 1.0]])
    assert (result.zero, result.negative) == (2, 0)


def test_negative_modes_have_no_frequency_and_are_counted():
    result = averages.frequencies(np.array([[-1e-3, 0.0, 1e-17, 1.0]]))
    assert_allclose(result.frequency, [[np.nan, np.nan, np.nan, 1.0]])
    assert (result.zero, result.negative) == (2, 1)


def test_free_rattlers_are_zero_modes_and_a_sample_without_modes_has_none():
    eigenvalue = np.array([[0.0, 1e-17, -2e-17, 3e-17, 1.0], [np.nan] * 5])
    result = averages.frequencies(eigenvalue)
    assert_array_equal(result.zero, [4, 0])
    assert_array_equal(result.negative, [0, 0])
    assert np.isfinite(result.frequency).sum() == 1


def test_bins_without_friction_are_40_logarithmic_and_500_linear():
    edges = binning.bin_edges(0.0, 1e-5, 1.0)
    assert len(edges) == 40 + 500 + 1
    assert_allclose(edges[:41], 10.0 ** np.linspace(-5, -1, 41))
    assert_allclose(edges[40:], np.linspace(0.1, 1.0, 501))


def test_rotational_window_is_redivided_into_100_linear_bins():
    edges = binning.bin_edges(1e-4, 1e-5, 1.0)
    window = edges[(edges > 1e-3 * (1 - 1e-12)) & (edges < 2e-2 * (1 + 1e-12))]
    assert_allclose(window, np.linspace(1e-3, 2e-2, 101))
    assert_allclose(edges[20], 1e-3)
    assert_allclose(edges[:20], 10.0 ** np.linspace(-5, -3.1, 20))


@pytest.mark.parametrize("kappa", [0.0, 1e-8, 1e-4, 1.0, 10.0, 1e6])
@pytest.mark.parametrize("bin_density", [1.0, 0.1])
def test_bins_ascend_over_exactly_the_range_of_the_data(kappa, bin_density):
    edges = binning.bin_edges(kappa, 0.013, 4.07, bin_density)
    assert (edges[0], edges[-1]) == (0.013, 4.07)
    assert (np.diff(edges) > 0).all()


def test_bin_density_scales_the_numbers_of_linear_bins():
    edges = binning.bin_edges(1e-4, 1e-5, 1.0, bin_density=0.1)
    assert ((edges >= 0.1 * (1 - 1e-12)) & (edges <= 1.0)).sum() == 51
    assert ((edges > 1e-3 * (1 - 1e-12)) & (edges < 2e-2 * (1 + 1e-12))).sum() == 11


@pytest.mark.parametrize("limits", [(1.0, 1.0), (0.0, 1.0), (2.0, 1.0)])
def test_bins_need_a_range(limits):
    with pytest.raises(ValueError, match="expected 0 < lowest < highest"):
        binning.bin_edges(1.0, *limits)


def test_density_of_states_by_hand():
    frequency, edges = np.array([[0.5, 1.5, 1.6], [0.25, np.nan, 4.0]]), np.array([0.0, 1, 2, 4])
    density = averages.density_of_states(binning.occupation(frequency, edges), 2, edges)
    assert_allclose(density.mean, np.array([2 / 2, 2 / 2, 1 / 2 / 2]) / 6)
    assert_allclose(density.standard_error, np.array([0.0, 1.0, 0.25]) / 6)
    assert_array_equal(density.samples, [2, 2, 2])


def test_density_of_states_integrates_to_the_fraction_of_modes():
    draws = np.random.default_rng(1)
    eigenvalue = np.hstack([np.zeros((3, 2)), draws.uniform(1e-9, 3.0, (3, 40))])
    eigenvalue[2, 30:] = np.nan
    frequency = averages.frequencies(eigenvalue).frequency
    edges = binning.bin_edges(1e-4, np.nanmin(frequency), np.nanmax(frequency))
    density = averages.density_of_states(binning.occupation(frequency, edges), 16, edges)
    modes = (40 + 40 + 28) / 3
    assert_allclose((density.mean * np.diff(edges)).sum(), modes / (3 * 16))


def test_density_of_states_counts_a_sample_without_modes_as_zero():
    density = averages.density_of_states(np.array([[1.0], [0.0]]), 1, np.array([0.0, 1.0]))
    assert_allclose(density.mean, [0.5 / 3])


def exact(*totals):
    return binning.BinSums(np.array(totals), np.zeros_like(totals))


def test_mode_average_is_a_ratio_of_sums_not_a_mean_of_ratios():
    count = np.array([[3.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
    result = averages.mode_average(count, exact([3.0, 0.0, 0.0], [0.0, 0.25, 0.0]))
    assert_allclose(result.mean, [3 / 4, 0.25, np.nan])
    residuals = np.array([3 - 0.75 * 3, 0 - 0.75 * 1])
    assert_allclose(result.standard_error[0], np.sqrt(2 * (residuals**2).sum()) / 4)
    assert_array_equal(result.samples, [2, 1, 0])
    assert np.isnan(result.standard_error[1:]).all()


def test_mode_average_leaves_out_samples_in_which_the_number_is_unknown():
    count = np.array([[2.0], [2.0], [6.0]])
    result = averages.mode_average(count, exact([1.0], [2.0], [np.nan]))
    assert_allclose(result.mean, 3 / 4)
    assert_allclose(result.standard_error, np.sqrt(2 * (0.5**2 + 0.5**2)) / 4)
    assert_array_equal(result.samples, [2])


def test_stated_errors_are_the_least_that_an_average_has():
    count, total = np.array([[2.0, 2.0], [2.0, 2.0]]), np.array([[1.0, 0.2], [1.0, 1.8]])
    result = averages.mode_average(count, binning.BinSums(total, np.full((2, 2), 0.3)))
    assert_allclose(result.standard_error[0], 0.3 * np.sqrt(2) / 4)
    assert_allclose(result.standard_error[1], np.sqrt(2 * 2 * 0.8**2) / 4)
    single = averages.mode_average(count[:1], binning.BinSums(total[:1], np.array([[0.3, 0.0]])))
    assert_allclose(single.standard_error, [0.15, np.nan])


def test_modes_in_bins_are_sums_and_what_lies_outside():
    frequency = np.array([[np.nan, 0.5, 0.6, 1.5, 9.0], [0.1, 1.0, 2.0, np.nan, np.nan]])
    psi = np.array([[0.0, 0.25, 0.5, 1.0, 1.0], [1.0, 0.1, 0.2, np.nan, np.nan]])
    found = binning.bin_modes(
        frequency, np.array([5, 3]), psi, np.nan * psi, np.array([0.2, 1.0, 2.0])
    )
    assert_array_equal(found.count, [[2, 1], [0, 2]])
    assert_array_equal(found.outside, [2, 1])
    assert_allclose(found.psi_rotational.total, [[0.75, 1.0], [0.0, 0.3]])
    assert_array_equal(found.psi_rotational.error, 0.0)
    mean = averages.mode_average(found.count, found.participation_ratio).mean
    assert_array_equal(mean, [np.nan, np.nan])
