"""The sign of a permutation, against the determinant of its matrix."""

import numpy as np
import pytest

from grainmodes.kernels.permutations import is_odd


@pytest.mark.parametrize("size", [1, 2, 5, 40])
def test_a_permutation_is_odd_where_its_matrix_has_determinant_minus_one(size):
    for seed in range(10):
        order = np.random.default_rng(seed).permutation(size)
        assert is_odd(order) == (np.linalg.det(np.eye(size)[order]) < 0.0)
