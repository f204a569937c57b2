"""Eigenbasis continuation: the complex pairs of one K after another along a shear.

The eigenvectors change little from one state of a shear to the next. In the eigenbasis V of the
state before, the next K is nearly diagonal:

    B = V⁻¹ K V = diag(d) + E,   d_k = B_kk

A *pass* solves B X = X Λ by second-order partitioning (`partitioning`), and the new eigenbasis is
V X. All of it is in single precision, and V need not be exact: a pass squares the distance from V
to the eigenvectors. The complex pairs are then refined as invariant subspaces until their
residuals, in double precision, are small (`refinement`). Where the trace defect is too large, too
many eigenvalues are near-degenerate or a subspace stays unconverged, another pass starts from the
new basis. Where an eigenvalue is missing or counted twice, E is too large, and the basis first
moves to the eigenvectors of diag(d) + E/2 or diag(d) + E/4. LAPACK solves what is left, and every K
whose backbone differs from that of the state before.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.definition import (
    ComplexPairs,
    DynamicalMatrix,
    dense_eigenpairs,
    select_pairs,
)
from grainmodes.complex_pairs.partitioning import Eigensystem, partitioned_eigensystem
from grainmodes.complex_pairs.refinement import Eigenbasis, refined_subspaces

TRACE_TOLERANCE = 1e-3
"""|Σλ − tr B| above which the subspaces are not refined, k_N d^(1/2)/m."""

MAX_PASSES, MAX_HALVINGS = 5, 2
"""Passes for one K, after which LAPACK costs no more, and halvings of E in each pass."""


class EigenbasisContinuation:
    """Finds complex pairs from the eigenbasis of the last K; `dense`: LAPACK solved this one."""

    def __init__(self) -> None:
        self._basis: Eigenbasis | None = None
        self._backbone = np.zeros(0, bool)
        self.dense = True

    def find(self, problem: DynamicalMatrix) -> ComplexPairs:
        """All complex pairs of K; its two zero modes are continued like all other modes.

        Raises:
            numpy.linalg.LinAlgError: the dense eigensolver did not converge.
        """
        self.dense = False
        if self._basis is not None and np.array_equal(self._backbone, problem.backbone):
            for _ in range(MAX_PASSES):
                self._basis, found = _pass(problem.matrix, self._basis)
                if found is None:
                    break
                if found.trace_defect < TRACE_TOLERANCE:
                    subspaces = refined_subspaces(problem.matrix, self._basis, found)
                    if subspaces is not None:
                        return subspaces.pairs
        values, left, right = dense_eigenpairs(problem.matrix)
        order = np.lexsort((-values.imag, values.real))
        real_columns = np.where(values.imag < 0.0, -right.imag, right.real)[:, order]
        self._basis = Eigenbasis.from_vectors(real_columns)
        self._backbone, self.dense = problem.backbone, True
        return select_pairs(values, right, left)


def _pass(matrix: sparse.csr_array, basis: Eigenbasis) -> tuple[Eigenbasis, Eigensystem | None]:
    """The next eigenbasis and the eigenpairs of B by partitioning; None where this fails."""
    image = matrix.astype(np.float32) @ basis.vectors
    quotients = np.einsum("nk,nk->k", basis.vectors, image)
    perturbation = basis.inverse @ (image - basis.vectors * quotients)
    diagonal = quotients.astype(float) + np.diagonal(perturbation)
    order = np.argsort(diagonal, kind="stable")
    perturbation = np.take(perturbation[order], order, axis=1)
    np.fill_diagonal(perturbation, 0.0)
    for halvings in range(MAX_HALVINGS + 1):
        found = partitioned_eigensystem(diagonal[order], perturbation)
        if found is not None:
            moved = Eigenbasis.from_vectors(basis.vectors[:, order] @ found.rows.T)
            return moved, found._replace(trace_defect=np.inf) if halvings else found
        perturbation *= 0.5
    return basis, None
