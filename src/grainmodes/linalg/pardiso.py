"""MKL PARDISO for real symmetric indefinite matrices.

PARDISO pivots with 1 × 1 and 2 × 2 blocks (Bunch–Kaufman) inside its supernodes. It chooses pivots
by size, so that it needs a matrix whose rows are scaled (`symmetric_shift`).
"""

from __future__ import annotations

import os
from functools import cache
from typing import Any
from weakref import finalize

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

from grainmodes.linalg.factorisation import Number, ZeroPivotError
from grainmodes.linalg.failures import FactorisationError
from grainmodes.runtime.pardiso import problem

PARAMETERS = {
    1: 1,  # the values below instead of defaults
    2: 2,  # nested dissection
    8: 0,  # no refinement: `PinnedFactor` refines its solutions itself
    10: 13,  # perturb pivots below 1e-13 only: at the default 1e-8 counts go silently wrong
    11: 0,  # no scaling of its own
    13: 0,  # no matching
    21: 1,  # Bunch-Kaufman pivots
    24: 0,  # the factorisation whose order of operations never varies
    34: 1,  # bitwise reproducible on one thread
}
"""Entries of PARDISO's `iparm`, numbered from 1 as in its manual."""

ANALYSE, FACTOR, SOLVE, RELEASE = 11, 22, 33, -1
"""PARDISO's numbers of its phases."""

PERTURBED_PIVOTS, NEGATIVE_EIGENVALUES = 14, 23
"""Entries of `iparm` in which PARDISO reports."""

ERRORS: dict[int, type[Exception]] = {
    -2: MemoryError,
    -9: MemoryError,
    -4: ZeroPivotError,
    -7: ZeroPivotError,
}
"""Exceptions by PARDISO's error code; any other code is none of the sample."""


class Pardiso:
    """Factors of real symmetric matrices with one pattern.

    Args:
        pattern: (M, M) sorted CSC with a symmetric pattern; its values are not read.

    Raises:
        FactorisationError: PARDISO is missing or does not load.
    """

    name = "pardiso"

    def __init__(self, pattern: sparse.csc_array):
        if problem():
            raise FactorisationError(f"factorisation: {problem()}")
        from pypardiso import PyPardisoSolver
        from pypardiso.pardiso_wrapper import PyPardisoError

        _locate_mkl()
        self._error = PyPardisoError
        self._solver = PyPardisoSolver(mtype=-2)
        for number, value in PARAMETERS.items():
            self._solver.set_iparm(number, value)
        places = sparse.csc_array(
            (np.arange(1, pattern.nnz + 1), pattern.indices, pattern.indptr), shape=pattern.shape
        )
        # Symmetric: the lower triangle by columns is the upper one by rows, which PARDISO wants.
        lower = sparse.tril(places).tocsc()
        lower.sort_indices()
        self._upper_places = lower.data - 1
        self._upper = sparse.csr_matrix(
            (np.zeros(lower.nnz), lower.indices, lower.indptr), shape=pattern.shape
        )
        self._no_right_side = np.zeros((pattern.shape[0], 1))
        self._analysed = False
        finalize(self, _release, self._solver, self._upper, self._no_right_side)

    def refactor(self, values: NDArray[Number]) -> int:
        """Factor the matrix with entries `values` (nnz,); the number of its negative pivots.

        Raises:
            ZeroPivotError: as `Factorisation.refactor`.
            MemoryError: the factors do not fit into memory.
        """
        self._upper.data[:] = values[self._upper_places]
        if not self._analysed:
            self._run(ANALYSE, self._no_right_side)
            self._analysed = True
        self._run(FACTOR, self._no_right_side)
        if self._solver.get_iparm(PERTURBED_PIVOTS):
            raise ZeroPivotError("a pivot of the factorisation is zero")
        return int(self._solver.get_iparm(NEGATIVE_EIGENVALUES))

    def solve(self, right: NDArray[Number]) -> NDArray[Number]:
        """Solutions (M,) or (M, K) of A x = b; as `Factorisation.solve`."""
        columns = np.asfortranarray(right.reshape(len(right), -1))
        return self._run(SOLVE, columns).reshape(right.shape)

    def _run(self, phase: int, columns: NDArray[Number]) -> NDArray[Number]:
        self._solver.set_phase(phase)
        try:
            solution: NDArray[Number] = self._solver._call_pardiso(self._upper, columns)
        except self._error as error:
            raise ERRORS.get(error.value, FactorisationError)(f"PARDISO: {error}") from error
        return solution


@cache
def _locate_mkl() -> None:
    """Tell pypardiso where MKL lies; otherwise each solver searches the whole environment."""
    from pypardiso import PyPardisoSolver

    os.environ["PYPARDISO_MKL_RT"] = PyPardisoSolver().libmkl._name


def _release(solver: Any, upper: sparse.csr_matrix, no_right_side: NDArray[np.float64]) -> None:
    """Free the memory that MKL holds for a solver."""
    solver.set_phase(RELEASE)
    solver._call_pardiso(upper, no_right_side)
