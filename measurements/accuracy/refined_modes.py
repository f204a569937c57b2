"""Eigenpairs of a symmetric J beyond the rounding of ‖J‖: the reference for spectra.

One step of Ogita and Aishima's iteration doubles the correct digits of all eigenvectors X at once,

    λ_i = x_i · J x_i,   R = J X − X Λ,   X → X (1 + E),   E_ij = (Xᵀ R)_ij / (λ_j − λ_i),

with R in extended precision: errors of 1e-7 in X, as divide and conquer leaves them in a dense
band of soft modes, become 1e-14. The Rayleigh quotients of the new X, in extended precision too,
are the eigenvalues; their error is of second order in that of X. Where the machine has no extended
precision, long doubles are doubles and the reference is no better than the best point.
"""

from __future__ import annotations

import numpy as np

from grainmodes.spectrum import dense
from grainmodes.spectrum.eigenproblem import Eigenproblem

DEGENERATE_GAP = 1e-15
"""Difference of two eigenvalues, in units of ‖J‖, below which their vectors may stay mixed: the
zero modes."""


def refined_eigenpairs(eigenproblem: Eigenproblem) -> tuple[np.ndarray, np.ndarray]:
    """λ (M,) ascending, and X (M, M), one column a mode, of a symmetric J."""
    vectors = dense.eigenpairs(eigenproblem)[1]
    values, residual = _rayleigh_quotients(eigenproblem.matrix, vectors)
    gap = values[None, :] - values[:, None]
    separate = np.abs(gap) > DEGENERATE_GAP * np.abs(values).max()
    turn = np.divide(vectors.T @ residual, gap, out=np.zeros_like(gap), where=separate)
    vectors = vectors + vectors @ turn
    vectors /= np.linalg.norm(vectors, axis=0)
    values, _ = _rayleigh_quotients(eigenproblem.matrix, vectors)
    order = np.argsort(values, kind="stable")
    return values[order], vectors[:, order]


def _rayleigh_quotients(matrix, vectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rayleigh quotients (M,) and residuals (M, M), rounded from extended precision."""
    exact = vectors.astype(np.longdouble)
    image = matrix @ exact
    values = (exact * image).sum(axis=0) / (exact * exact).sum(axis=0)
    return values.astype(float), (image - exact * values).astype(float)
