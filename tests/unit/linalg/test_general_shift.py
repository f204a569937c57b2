"""Solutions of a K − σ that is not symmetric, from factors without pivoting, against dense ones."""

import numpy as np
import pytest
import scipy.sparse as sparse

from grainmodes.linalg import general_shift
from grainmodes.linalg.factorisation import ZeroPivotError
from grainmodes.linalg.general_shift import GeneralShift
from grainmodes.linalg.superlu import SuperLU


def ladder(size: int) -> sparse.csr_array:
    """A band matrix with eigenvalues from 0.1 to 1.5 that is not symmetric; its pattern is."""
    draws, matrix = np.random.default_rng(0), np.diag(np.linspace(0.1, 1.5, size))
    for off in (1, 2, 7):
        for side in (off, -off):
            matrix += np.diag(0.05 * draws.standard_normal(size - off), side)
    return sparse.csr_array(matrix)


MATRIX = ladder(90)
SHIFTS = (-0.01, 0.4321, 0.9 + 0.05j)


@pytest.mark.parametrize("shift", SHIFTS)
def test_the_solutions_are_those_of_the_dense_matrix(shift):
    factors, right = (
        GeneralShift(MATRIX).factor_at(shift),
        np.random.default_rng(1).standard_normal((90, 3)),
    )
    dense = MATRIX.toarray() - shift * np.eye(90)
    right = right.astype(dense.dtype)
    for solve, shifted in ((factors.solve, dense), (factors.solve_transposed, dense.T)):
        np.testing.assert_allclose(solve(right), np.linalg.solve(shifted, right), rtol=1e-9)
        np.testing.assert_allclose(solve(right[:, 0]), solve(right)[:, 0], rtol=1e-12)


def test_one_shift_after_the_other_gives_the_same_as_each_alone():
    factors, right = GeneralShift(MATRIX), np.ones(90)
    for shift in SHIFTS:
        alone = GeneralShift(MATRIX).factor_at(shift).solve(right.astype(type(shift)))
        np.testing.assert_array_equal(
            factors.factor_at(shift).solve(right.astype(type(shift))), alone
        )


def test_an_eigenvalue_as_shift_is_perturbed():
    answer = (
        GeneralShift(sparse.csr_array(np.diag([1.0, 2.0, 3.0]))).factor_at(2.0).solve(np.ones(3))
    )
    assert np.argmax(np.abs(answer)) == 1 and np.isfinite(answer).all()


def test_a_matrix_that_stays_singular_is_refused(monkeypatch):
    def singular(self, values):
        raise ZeroPivotError("a pivot of the factorisation is zero")

    monkeypatch.setattr(SuperLU, "refactor", singular)
    with pytest.raises(ZeroPivotError, match="singular at sigma"):
        GeneralShift(MATRIX).factor_at(0.5)


def test_rough_factors_are_refined(monkeypatch):
    """A first pivot of 1e-7 grows the others to 1e7 and costs every solution nine digits."""
    matrix = np.random.default_rng(2).standard_normal((30, 30))
    matrix[0, 0] = 1e-7
    right = np.random.default_rng(3).standard_normal(30)

    def missing() -> float:
        factors = GeneralShift(sparse.csr_array(matrix)).factor_at(0.0)
        return max(
            np.abs(matrix @ factors.solve(right) - right).max(),
            np.abs(matrix.T @ factors.solve_transposed(right) - right).max(),
        )

    assert missing() < 1e-12
    monkeypatch.setattr(general_shift, "MAX_BACKWARD_ERROR", np.inf)
    assert missing() > 1e-10
