"""Rows of different lengths in one array."""

import numpy as np
import pytest

from grainmodes.dataset.padding import stack_padded


def test_shorter_rows_are_filled_up():
    rows = [np.array([1.0]), None, np.array([2.0, 3.0])]
    expected = [[1.0, np.nan], [np.nan, np.nan], [2.0, 3.0]]
    np.testing.assert_array_equal(stack_padded(rows, np.nan), expected)


def test_every_dimension_is_filled_up_and_the_type_is_kept():
    rows = [np.ones((1, 3), np.int8), np.full((2, 1), 2, np.int8)]
    stacked = stack_padded(rows, -1)
    np.testing.assert_array_equal(stacked[0], [[1, 1, 1], [-1, -1, -1]])
    np.testing.assert_array_equal(stacked[1], [[2, -1, -1], [2, -1, -1]])
    assert stacked.dtype == np.int8


def test_numbers_are_rows_without_dimensions():
    np.testing.assert_array_equal(stack_padded([1, None, 3], 0), [1, 0, 3])


def test_rows_of_no_length_and_a_smallest_shape():
    stacked = stack_padded([[], []], np.nan, float, min_shape=(2,))
    np.testing.assert_array_equal(stacked, np.full((2, 2), np.nan))


def test_rows_that_are_all_missing_are_single_numbers():
    np.testing.assert_array_equal(stack_padded([None, None], 0, np.int8), [0, 0])


def test_rows_of_different_dimensions_are_refused():
    with pytest.raises(ValueError, match="expected one number of dimensions"):
        stack_padded([np.zeros(2), np.zeros((2, 2))], 0.0)
