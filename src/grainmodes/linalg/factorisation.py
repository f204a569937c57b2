"""Sparse factorisations of a symmetric pattern with many sets of values: chosen here, only here.

SuperLU comes with SciPy and is always there. PARDISO (`pip install grainmodes[pardiso]`) is five to
ten times faster and gives the same counts and, to rounding, the same solutions. Both reorder the
pattern once; after that each new set of values costs a numerical factorisation only.

SuperLU does not pivot here: a symmetric permutation and L, U with the signs of an L D Lᵀ; factors
that grow beyond `GROWTH` are refused. PARDISO pivots with 1 × 1 and 2 × 2 blocks (Bunch–Kaufman)
inside its supernodes.
"""

from __future__ import annotations

import os
from functools import cache
from importlib.util import find_spec
from typing import Protocol
from weakref import finalize

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from grainmodes.parameters.factors import PARDISO_FROM

GROWTH = 1e9
"""Largest entry of the factors, in the largest of the matrix: the entries of the matrix are kept to
1e-16 of it, so that a count is right at λ (1 ± 1e-7) even at the worst shift that is accepted."""

PARDISO_CHOICES = {
    1: 1,  # the choices below instead of defaults
    2: 2,  # nested dissection
    8: 0,  # no refinement: `SymmetricShift` refines where it must
    10: 13,  # perturb pivots below 1e-13 only: at the default 1e-8 counts go silently wrong
    11: 0,  # no scaling of its own
    13: 0,  # no matching
    21: 1,  # Bunch-Kaufman pivots
    24: 0,  # the factorisation whose order of operations never varies
    34: 1,  # bitwise reproducible on one thread
}
"""Entries of `iparm`, numbered from 1 as in the manual."""


class Factorisation(Protocol):
    """The factors of a symmetric matrix; `refill` replaces its values and the factors with it."""

    name: str

    def refill(self, values: np.ndarray) -> int:
        """Factor the matrix with these values of its entries; return its negative eigenvalues.

        Raises:
            ZeroPivotError: the matrix is singular to rounding; no inertia can be told.
        """

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Solutions of one or several right-hand sides, (M,) or (M, K)."""


class ZeroPivotError(ArithmeticError):
    """A pivot vanishes: the shift is an eigenvalue to rounding."""


PARDISO_ERRORS = {-2: MemoryError, -9: MemoryError, -4: ZeroPivotError, -7: ZeroPivotError}
"""What the error codes of PARDISO mean; any other one is a mistake in the code."""


def factorisation(pattern: sparse.csc_array, backend: str = "auto") -> Factorisation:
    """A factorisation for matrices with the entries of `pattern`, (M, M), symmetric, sorted CSC.

    Args:
        backend: "superlu", "pardiso", or "auto": PARDISO where installed and worth it.

    Raises:
        ValueError: PARDISO is asked for and not installed, or the backend is unknown.
    """
    name = chosen(backend, pattern.shape[0])
    return Pardiso(pattern) if name == "pardiso" else SuperLU(pattern)


def chosen(backend: str, size: int) -> str:
    """The factorisation that `factorisation` takes for a matrix of `size` rows.

    Raises:
        ValueError: as `factorisation`.
    """
    installed = find_spec("pypardiso") is not None
    if backend == "auto":
        return "pardiso" if installed and size >= PARDISO_FROM else "superlu"
    if backend == "pardiso" and not installed:
        raise ValueError(
            "factorisation 'pardiso' is not installed: pip install 'grainmodes[pardiso]', or allow "
            "'superlu' or 'auto'"
        )
    if backend not in ("superlu", "pardiso"):
        raise ValueError(f"factorisation {backend!r}: allowed are auto, superlu, pardiso")
    return backend


class SuperLU:
    """SciPy's SuperLU in symmetric mode; the order found first serves every later set of values."""

    name = "superlu"

    def __init__(self, pattern: sparse.csc_array):
        self._indices, self._indptr, self._shape = pattern.indices, pattern.indptr, pattern.shape
        self._order: np.ndarray | None = None

    def refill(self, values: np.ndarray) -> int:
        if self._order is None:
            matrix = sparse.csc_array((values, self._indices, self._indptr), shape=self._shape)
            self._order = elimination_order(matrix)
            self._take = _permutation_of_entries(matrix, self._order)
        matrix = sparse.csc_array(
            (values[self._take.data], self._take.indices, self._take.indptr), shape=self._shape
        )
        self._factors = _symmetric_lu(matrix, "NATURAL")
        if not np.array_equal(self._factors.perm_r, self._factors.perm_c):
            raise ZeroPivotError("a pivot of the factorisation is zero")
        upper = self._factors.U
        if not np.abs(upper.data).max(initial=0.0) < GROWTH * np.abs(values).max(initial=1.0):
            raise ZeroPivotError("a pivot of the factorisation is too small")
        return int(np.count_nonzero(upper.diagonal().real < 0.0))

    def solve(self, right: np.ndarray, of: str = "N") -> np.ndarray:
        """As `Factorisation.solve`; of the transposed matrix with `of` "T"."""
        answer = np.empty_like(right)
        answer[self._order] = self._factors.solve(right[self._order], of)
        return answer


def elimination_order(pattern: sparse.csc_array) -> np.ndarray:
    """An order (M,) of the unknowns that keeps the factors sparse: minimum degree, grain by grain.

    Columns with the same entries, those of one grain, are eliminated together, so that the graph to
    be ordered is that of the grains: a ninth of the matrix, whose factors are thrown away.
    """
    column = np.repeat(np.arange(pattern.shape[1]), np.diff(pattern.indptr))
    entry = pattern.indices
    marks = np.bincount(column, np.sqrt(entry + 1.0), pattern.shape[1])
    _, group = np.unique(marks, return_inverse=True)
    every = np.arange(group.max(initial=-1) + 1)
    first = np.unique(group[entry] * len(every) + group[column])
    row, other = (np.concatenate([part, every]) for part in np.divmod(first, len(every)))
    weight = np.repeat([-1.0, len(every) + 1.0], [len(first), len(every)])
    graph = sparse.coo_array((weight, (row, other)), shape=(len(every), len(every))).tocsc()
    # perm_c[old] = new
    return np.argsort(_symmetric_lu(graph, "MMD_AT_PLUS_A").perm_c[group], kind="stable")


def _symmetric_lu(matrix: sparse.csc_array, order: str):
    # relax=1: no zeros are added to the factors for longer supernodes; a third faster here.
    options = {"SymmetricMode": True, "Equil": False}
    try:
        return splu(matrix, permc_spec=order, diag_pivot_thresh=0.0, relax=1, options=options)
    except RuntimeError as error:
        raise ZeroPivotError(f"the matrix is singular ({error})") from error


def _permutation_of_entries(matrix: sparse.csc_array, order: np.ndarray) -> sparse.csc_array:
    """The pattern in the new order; each entry holds its place in the old values."""
    places = np.arange(matrix.nnz)
    numbered = sparse.csc_array((places, matrix.indices, matrix.indptr), shape=matrix.shape)
    permuted = numbered[order][:, order].tocsc()
    permuted.sort_indices()
    return permuted


class Pardiso:
    """MKL PARDISO for real symmetric indefinite matrices."""

    name = "pardiso"
    _ANALYSE, _FACTOR, _SOLVE = 11, 22, 33
    _ZERO_PIVOTS, _NEGATIVE = 14, 23

    def __init__(self, pattern: sparse.csc_array):
        from pypardiso import PyPardisoSolver
        from pypardiso.pardiso_wrapper import PyPardisoError

        _locate_mkl()
        self._error = PyPardisoError
        self._solver = PyPardisoSolver(mtype=-2)
        for number, value in PARDISO_CHOICES.items():
            self._solver.set_iparm(number, value)
        places = sparse.csc_array(
            (np.arange(1, pattern.nnz + 1), pattern.indices, pattern.indptr), shape=pattern.shape
        )
        # Symmetric: the lower triangle by columns is the upper one by rows, which PARDISO wants.
        lower = sparse.tril(places).tocsc()
        lower.sort_indices()
        self._take = lower.data - 1
        self._upper = sparse.csr_matrix(
            (np.zeros(lower.nnz), lower.indices, lower.indptr), shape=pattern.shape
        )
        self._nothing = np.zeros((pattern.shape[0], 1))
        self._analysed = False
        finalize(self, _release, self._solver, self._upper, self._nothing)

    def refill(self, values: np.ndarray) -> int:
        self._upper.data[:] = values[self._take]
        if not self._analysed:
            self._run(self._ANALYSE, self._nothing)
            self._analysed = True
        self._run(self._FACTOR, self._nothing)
        if self._solver.get_iparm(self._ZERO_PIVOTS):
            raise ZeroPivotError("a pivot of the factorisation is zero")
        return int(self._solver.get_iparm(self._NEGATIVE))

    def solve(self, right: np.ndarray) -> np.ndarray:
        columns = np.asfortranarray(right.reshape(len(right), -1))
        return self._run(self._SOLVE, columns).reshape(right.shape)

    def _run(self, phase: int, columns: np.ndarray) -> np.ndarray:
        self._solver.set_phase(phase)
        try:
            return self._solver._call_pardiso(self._upper, columns)
        except self._error as error:
            raise PARDISO_ERRORS.get(error.value, RuntimeError)(str(error)) from error


@cache
def _locate_mkl() -> None:
    """Say where MKL lies: each solver would else walk through the whole environment to find it."""
    from pypardiso import PyPardisoSolver

    os.environ["PYPARDISO_MKL_RT"] = PyPardisoSolver().libmkl._name


def _release(solver, upper: sparse.csr_matrix, nothing: np.ndarray) -> None:
    """Give back the memory that MKL holds for a solver."""
    solver.set_phase(-1)
    solver._call_pardiso(upper, nothing)
