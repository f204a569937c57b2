"""Solutions and stability of matrices with two pinned unknowns, against dense ones."""

import numpy as np
import pytest
import scipy.sparse as sparse

from grainmodes.linalg.factorisation import ZeroPivotError
from grainmodes.linalg.pinned_factor import FloppyError, PinnedFactor
from grainmodes.linalg.superlu import SuperLU


def chain(size: int, asymmetry: float, seed: int = 0) -> sparse.csc_array:
    """A band matrix with eigenvalues of positive real part, its rows of very different size."""
    draws, matrix = np.random.default_rng(seed), np.diag(np.full(size, 4.0))
    for off in (1, 3):
        upper = -np.ones(size - off)
        matrix += np.diag(upper, off) + np.diag(upper, -off)
        matrix += np.diag(asymmetry * draws.standard_normal(size - off), off)
    scale = np.where(np.arange(size) % 3 == 2, 1e-4, 1.0)
    return sparse.csc_array(scale[:, None] * matrix * scale)


@pytest.mark.parametrize("symmetric", [True, False])
def test_solutions_are_those_of_the_dense_matrix_without_the_pinned_unknowns(symmetric):
    matrix = chain(60, 0.0 if symmetric else 0.3)
    right = np.random.default_rng(1).standard_normal(60)
    u = PinnedFactor(matrix, symmetric).solve(right)
    expected = np.linalg.solve(matrix.toarray()[2:, 2:], right[2:])
    assert u[0] == u[1] == 0.0
    np.testing.assert_allclose(u[2:], expected, rtol=1e-10)


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("shift", [0.0, -1e-8, -3e-8, -4.5])
def test_a_matrix_is_unstable_if_an_eigenvalue_has_a_negative_real_part(symmetric, shift):
    matrix = chain(63, 0.0 if symmetric else 0.3) + shift * sparse.eye_array(63)
    values = np.linalg.eigvals(matrix.toarray()[2:, 2:])
    assert PinnedFactor(matrix.tocsc(), symmetric).unstable == (values.real.min() < 0.0)


def test_every_negative_pivot_of_a_negated_matrix_is_counted():
    factor = PinnedFactor(-chain(60, 0.3), symmetric=False)
    assert factor.unstable and factor._factor.n_below == 58


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("excess", [0.0, 1e-13])
def test_zero_modes_beyond_the_pinned_ones_are_refused(symmetric, excess):
    """Exact ones, and those that are zero to rounding."""
    springs = np.diag([1.0, 1.0, 1.0, 2.0, 1.0]) - np.diag([0, 0, 1.0, 1.0], 1)
    springs -= np.diag([0, 0, 1.0, 1.0], -1)
    with pytest.raises(FloppyError, match=r"singular|zero modes"):
        PinnedFactor(sparse.csc_array(springs + np.diag([0, 0, excess, 0, 0])), symmetric)


def test_an_unknown_without_any_stiffness_is_refused():
    with pytest.raises(FloppyError, match="no stiffness"):
        PinnedFactor(sparse.csc_array(np.diag([1.0, 1.0, 1.0, 0.0])), symmetric=True)


def test_rows_are_pivoted_where_elimination_in_order_fails(monkeypatch):
    matrix, right = chain(60, 0.3), np.random.default_rng(1).standard_normal(60)
    expected = PinnedFactor(matrix, symmetric=False)

    def fail(self, values):
        raise ZeroPivotError("a pivot of the factorisation is zero")

    monkeypatch.setattr(SuperLU, "refactor", fail)
    pivoted = PinnedFactor(matrix, symmetric=False, reuse_ordering_of=expected)
    assert pivoted.unstable == expected.unstable
    np.testing.assert_allclose(pivoted.solve(right), expected.solve(right), rtol=1e-8, atol=1e-9)
    again = PinnedFactor(matrix, symmetric=False, reuse_ordering_of=pivoted)
    np.testing.assert_allclose(again.solve(right), pivoted.solve(right), rtol=1e-12, atol=1e-13)


def test_the_order_of_elimination_is_reused_for_the_same_pattern_only(monkeypatch):
    matrix, right = chain(60, 0.3), np.ones(60)
    first = PinnedFactor(matrix, symmetric=False)
    order, orders = first._factor._factors._order, []
    monkeypatch.setattr(
        "grainmodes.linalg.superlu.elimination_order",
        lambda pattern: orders.append(pattern) or np.arange(pattern.shape[0]),
    )
    same = PinnedFactor(chain(60, 0.2, seed=1), symmetric=False, reuse_ordering_of=first)
    assert same._factor._factors._order is order and not orders
    other = PinnedFactor(chain(63, 0.3), symmetric=False, reuse_ordering_of=first)
    assert len(orders) == 1
    np.testing.assert_allclose(
        first.solve(right)[2:], np.linalg.solve(matrix.toarray()[2:, 2:], right[2:]), rtol=1e-10
    )
    assert np.isfinite(other.solve(np.ones(63))).all()
