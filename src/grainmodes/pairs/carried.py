"""The complex pairs of one J after the other, without solving any of them anew.

Eigenvectors change little from one state of a shear to the next. In those of the state before,
columns V, the next K is nearly diagonal:

    B = V⁻¹ K V = Λ + V⁻¹ (K V − V Λ)

and `nearly_diagonal` gives its eigenvalues and the new vectors, V X. V is real: for a complex pair
it holds Re u and Im u. It need not be exact, and is kept in single precision with its factors; the
residual K V − V Λ is not, so that λ is right far beyond that. What matters is the distance from V
to the eigenvectors, told by the coupling, and each pass takes it to its square:

| coupling         | then                                                                  |
| ---------------- | --------------------------------------------------------------------- |
| below `ENOUGH`   | the pairs are those of this pass                                      |
| above            | another pass from the new vectors, `MOST` at most, then LAPACK        |

Grains that come to carry load or cease to change the size of K: then, too, LAPACK solves it.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from grainmodes.pairs.definition import Pairs, dense_eigenpairs, selected
from grainmodes.pairs.nearly_diagonal import NearlyDiagonal, Solved, solved
from grainmodes.stability import REAL

ENOUGH = 0.1
"""Largest part of an eigenvector outside its window with which a pass is believed."""

MOST = 4
"""Passes, after which LAPACK costs no more."""


class Carried:
    """Finds pairs by carrying the eigenvectors of the last matrix on; `dense`: LAPACK did it."""

    def __init__(self) -> None:
        self._vectors = np.zeros((0, 0), np.float32)
        self.dense = True

    def find(self, matrix: sparse.csr_array, null: np.ndarray) -> Pairs:
        """Every complex pair of a matrix (M, M); its zero modes are carried like all others.

        Raises:
            numpy.linalg.LinAlgError: the dense eigensolver did not converge.
        """
        self.dense = False
        if matrix.shape == self._vectors.shape:
            for _ in range(MOST):
                found = self._pass(matrix)
                if found is None:
                    break
                self._carry(self._vectors @ found.rows.T)
                if found.coupling < ENOUGH:
                    return self._pairs(found.values)
        return self._anew(matrix)

    def _pass(self, matrix: sparse.csr_array) -> Solved | None:
        """B, put in the order of its diagonal, and its eigenpairs."""
        vectors = self._vectors.astype(float)
        moved = matrix @ vectors
        diagonal = np.einsum("nk,nk->k", vectors, moved)
        residual = (moved - vectors * diagonal).astype(np.float32)
        change = scipy.linalg.lu_solve(self._factors, residual, overwrite_b=True)
        order = np.argsort(diagonal + np.diagonal(change), kind="stable")
        diagonal = (diagonal + np.diagonal(change))[order]
        self._vectors = self._vectors[:, order]
        return solved(NearlyDiagonal.of(diagonal, change[np.ix_(order, order)]))

    def _carry(self, vectors: np.ndarray) -> None:
        """Keep vectors (M, M) for the next pass."""
        self._vectors = (vectors / np.linalg.norm(vectors, axis=0)).astype(np.float32)
        self._factors = scipy.linalg.lu_factor(self._vectors)

    def _pairs(self, values: np.ndarray) -> Pairs:
        """The pairs among eigenvalues, their vectors from V and from the rows of V⁻¹."""
        (at,) = np.nonzero(values.imag > REAL)
        unit = np.zeros((len(values), 2 * len(at)), np.float32)
        unit[np.concatenate([at, at + 1]), np.arange(2 * len(at))] = 1.0
        rows = scipy.linalg.lu_solve(self._factors, unit, trans=1)
        left = rows[:, : len(at)] + 1j * rows[:, len(at) :]
        right = self._vectors[:, at] + 1j * self._vectors[:, at + 1]
        return selected(values[at], right, left)

    def _anew(self, matrix: sparse.csr_array) -> Pairs:
        """By LAPACK, the vectors kept."""
        self.dense = True
        values, left, right = dense_eigenpairs(matrix)
        order = np.lexsort((-values.imag, values.real))
        columns = np.where(values.imag < 0.0, -right.imag, right.real)[:, order]
        self._carry(columns)
        return selected(values, right, left)
