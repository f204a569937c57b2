"""Eigenbasis continuation the slow way: dense, in double precision, without windows or refinement.

The fast version is `grainmodes.complex_pairs.continuation`.
"""

import numpy as np

from grainmodes.complex_pairs.definition import ComplexPairs, DynamicalMatrix, select_pairs
from grainmodes.complex_pairs.partitioning import Eigensystem


def dense_eigensystem(diagonal: np.ndarray, perturbation: np.ndarray) -> Eigensystem:
    """All eigenpairs of diag(d) + E by LAPACK, in the layout of `partitioned_eigensystem`."""
    values, vectors = np.linalg.eig(np.diag(diagonal) + perturbation)
    order = np.lexsort((-values.imag, values.real))
    values, vectors = values[order].astype(complex), vectors[:, order]
    rows = np.where(values.imag < 0.0, -vectors.imag, vectors.real).T
    defect = abs(values.real.sum() - diagonal.sum())
    return Eigensystem(values, rows, np.zeros(len(values)), defect)


class DenseContinuation:
    """Every K is transformed into the eigenbasis V of the one before: B = V⁻¹ K V, B X = X Λ."""

    dense = False
    basis = None

    def find(self, problem: DynamicalMatrix) -> ComplexPairs:
        """All complex pairs of K, with u = V x and v = V⁻ᵀ y."""
        matrix, size = problem.matrix.toarray(), problem.matrix.shape[0]
        basis = np.eye(size) if self.basis is None or len(self.basis) != size else self.basis
        values, vectors = np.linalg.eig(np.linalg.solve(basis, matrix @ basis))
        right = basis @ vectors
        self.basis = np.where(values.imag < 0.0, -right.imag, right.real)
        return select_pairs(values.astype(complex), right, np.linalg.inv(right).conj().T)
