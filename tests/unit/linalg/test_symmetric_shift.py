"""Counts and solutions of J − σ against exact inertia, dense spectra, and each other."""

import numpy as np
import pytest
import scipy.sparse as sparse

import exact
from example_packings import BACKENDS, MINIMAL, elastic, kt_and_backend, quenched, reference
from grainmodes.linalg import backends, pardiso
from grainmodes.linalg.factorisation import ZeroPivotError
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.spectrum import Eigenproblem, dense

KAPPAS = (1e-10, 1e-8, 1e-4, 1.0, 10.0)
EDGES = np.geomspace(1e-6, 3.0, 160) ** 2
"""Shifts from ω t_0 = 1e-6 to 3."""


def interleaved(problem) -> np.ndarray:
    """The shifts of `EDGES` and as many within the rotational and translational bands."""
    values = dense.eigenvalues(problem)
    inside = np.quantile(values[values > 1e-13], np.linspace(0.001, 0.999, 80))
    return np.concatenate([EDGES, 0.99 * inside])


@pytest.mark.parametrize("kt", [1e-10, 1e-4, 10.0])
@pytest.mark.parametrize("rank", [2, 10])
def test_counts_change_where_the_exact_ones_do(kt, rank):
    """To 1e-13 of an eigenvalue, where the dense one at k_T = 1e-10 has an error of 1e-6."""
    eigenproblem = Eigenproblem.from_packing(reference(MINIMAL[0])[1], elastic(MINIMAL[0], kt))
    shift, matrix = SymmetricShift(eigenproblem.matrix), eigenproblem.matrix.toarray()
    low, high = bracket(shift, dense.eigenvalues(eigenproblem)[rank])
    below = shift.factor_at(low).n_below
    assert below + 1 == shift.factor_at(high).n_below
    assert exact.count_below(matrix, low) == below
    assert exact.count_below(matrix, high) == below + 1


def bracket(shift: SymmetricShift, value: float) -> tuple[float, float]:
    """An interval of relative width 3e-13 around an eigenvalue near `value`, by counts."""
    low, high = value * (1 - 1e-4), value * (1 + 1e-4)
    below = shift.factor_at(low).n_below
    while high - low > 1e-13 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if shift.factor_at(middle).n_below == below else (low, middle)
    return low * (1 - 1e-13), high * (1 + 1e-13)


@pytest.mark.parametrize("phi", [0.845, 0.90])
@pytest.mark.parametrize(("kt", "backend"), kt_and_backend(*KAPPAS))
def test_counts_equal_the_dense_ones_at_every_edge(phi, kt, backend):
    compare_with_dense(144, phi, kt, backend)


def compare_with_dense(n: int, phi: float, kt: float, backend: str) -> None:
    """Counts without rattlers and with them."""
    packing = quenched(n, phi)
    for keep in (False, True):
        eigenproblem = Eigenproblem.from_packing(packing, elastic("hertz", kt), keep_rattlers=keep)
        shift, values = (
            SymmetricShift(eigenproblem.matrix, backend),
            dense.eigenvalues(eigenproblem),
        )
        edges = interleaved(eigenproblem)
        found = [shift.factor_at(edge).n_below for edge in edges]
        np.testing.assert_array_equal(found, np.searchsorted(values, edges))


@pytest.mark.slow
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("phi", [0.845, 0.90])
@pytest.mark.parametrize("kt", KAPPAS)
def test_counts_equal_the_dense_ones_for_a_thousand_grains(phi, kt, backend):
    compare_with_dense(1024, phi, kt, backend)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("kt", [1e-10, 1.0])
def test_solutions_satisfy_their_equation(kt, backend):
    eigenproblem = Eigenproblem.from_packing(quenched(256, 0.90), elastic("hertz", kt))
    shift = SymmetricShift(eigenproblem.matrix, backend).factor_at(0.3)
    right = np.random.default_rng(0).standard_normal((eigenproblem.size, 5))
    shifted = eigenproblem.matrix - 0.3 * sparse.eye_array(eigenproblem.size)
    np.testing.assert_allclose(shifted @ shift.solve(right), right, atol=1e-9)
    np.testing.assert_allclose(shift.solve(right[:, 0]), shift.solve(right)[:, 0], rtol=1e-9)


@pytest.mark.skipif("pardiso" not in BACKENDS, reason="PARDISO is not installed")
def test_factorisations_agree():
    eigenproblem = Eigenproblem.from_packing(quenched(256, 0.90), elastic("hertz", 1e-4))
    one, other = (SymmetricShift(eigenproblem.matrix, name) for name in ("superlu", "pardiso"))
    assert (one.backend, other.backend) == ("superlu", "pardiso")
    assert [one.factor_at(e).n_below for e in EDGES] == [other.factor_at(e).n_below for e in EDGES]
    right = np.random.default_rng(1).standard_normal(eigenproblem.size)
    np.testing.assert_allclose(
        one.factor_at(0.3).solve(right), other.factor_at(0.3).solve(right), rtol=1e-8
    )


@pytest.mark.parametrize("backend", BACKENDS)
def test_two_factorisations_do_not_disturb_each_other(backend):
    interaction = elastic("hertz", 1e-4)
    matrices = [Eigenproblem.from_packing(quenched(n, 0.90), interaction).matrix for n in (64, 256)]
    alone = [SymmetricShift(matrix, backend).factor_at(0.3).n_below for matrix in matrices]
    shifts = [SymmetricShift(matrix, backend).factor_at(0.3) for matrix in matrices]
    right = np.ones(shifts[0].size)
    assert [shift.n_below for shift in shifts] == alone
    expected = np.linalg.solve(matrices[0].toarray() - 0.3 * np.eye(len(right)), right)
    np.testing.assert_allclose(shifts[0].solve(right), expected, rtol=1e-8)


@pytest.mark.parametrize("backend", BACKENDS)
def test_counts_are_right_where_a_leading_part_is_singular(backend):
    eigenproblem = Eigenproblem.from_packing(quenched(128, 0.86), elastic("hertz", 1.0))
    values, shift = dense.eigenvalues(eigenproblem), eigenproblem.symmetric_shift("superlu")
    order = shift.factor_at(0.5)._factors._order
    leading = eigenproblem.matrix[order][:, order].toarray()
    shift = eigenproblem.symmetric_shift(backend)
    for size in (1, 2, 3, 5, 9, 17):
        for sigma in np.linalg.eigvalsh(leading[:size, :size]):
            if np.abs(values / sigma - 1.0).min() > 1e-6:
                assert shift.factor_at(sigma).n_below == np.searchsorted(values, sigma)


@pytest.mark.parametrize("backend", BACKENDS)
def test_empty_rows_are_zero_modes(backend):
    matrix = sparse.csc_array(np.diag([0.0, 1.0, 0.0, 4.0]))
    shift = SymmetricShift(matrix, backend)
    assert [shift.factor_at(sigma).n_below for sigma in (-1e-3, 1e-12, 2.0, 5.0)] == [0, 2, 3, 4]


def test_one_shift_per_row_counts_a_diagonal_exactly():
    values = np.array([1.0, 2.0, 3.0, 4.0])
    shift = SymmetricShift(sparse.csc_array(np.diag(values)))
    assert shift.factor_at(np.array([1.5, 1.5, 3.5, 3.5])).n_below == 2


def test_a_shift_on_an_eigenvalue_is_increased():
    shift = SymmetricShift(sparse.csc_array(np.diag([1.0, 2.0, 3.0])))
    assert shift.factor_at(2.0).n_below == 2


def test_a_singular_matrix_at_zero_is_refused():
    with pytest.raises(ZeroPivotError, match="singular at sigma = 0"):
        SymmetricShift(sparse.csc_array(np.diag([0.0, 1.0]))).factor_at(0.0)


def test_an_unknown_factorisation_is_refused():
    with pytest.raises(ValueError, match="expected auto, superlu or pardiso, got 'cholesky'"):
        SymmetricShift(sparse.csc_array(np.eye(2)), "cholesky")


@pytest.mark.skipif("pardiso" not in BACKENDS, reason="needs pypardiso")
def test_mkl_is_located_once(monkeypatch):
    from pypardiso import pardiso_wrapper

    monkeypatch.delenv("PYPARDISO_MKL_RT", raising=False)
    pardiso._locate_mkl.cache_clear()
    pattern = sparse.csc_array(np.eye(3))
    backends.make_factorisation(pattern, "pardiso")
    monkeypatch.delattr(pardiso_wrapper, "find_library")
    backends.make_factorisation(pattern, "pardiso")
