"""Two-dimensional subspaces, many at once, and how far each is from being invariant under K.

A subspace is spanned by R on the right and by L on the left, Lᵀ R = 1. Its block B is the matrix of
two-sided Rayleigh quotients, and it is invariant where both residuals vanish:

    B = Lᵀ K R,   K R − R B = 0,   Kᵀ L − L Bᵀ = 0

The eigenvalues λ of B are then those of K; elsewhere their error is of the order of the product of
both residuals. With B k = λ k and Bᵀ l = λ* l a complex pair has the vectors u = R k and v = L l.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.definition import ComplexPairs, select_pairs
from grainmodes.response.stability import REAL_TOLERANCE


class Subspaces(NamedTuple):
    """Two-dimensional subspaces with their blocks and residuals, float64.

    Attributes:
        right, left: R, orthonormal, and L, (P, 2, M).
        block: B, (P, 2, 2).
        right_residual, left_residual: K R − R B and Kᵀ L − L Bᵀ, (P, 2, M).
        residual: the larger of their norms, (P,), in units of max|K|, and of |L| for the left one.
    """

    right: np.ndarray
    left: np.ndarray
    block: np.ndarray
    right_residual: np.ndarray
    left_residual: np.ndarray
    residual: np.ndarray

    @classmethod
    def spanned_by(cls, matrix: sparse.csr_array, right: np.ndarray, left: np.ndarray) -> Subspaces:
        """The subspaces spanned by real vectors (P, 2, M) of any norm, for K (M, M)."""
        right, left = orthonormal(right), orthonormal(left)
        left = np.linalg.inv(left @ right.swapaxes(1, 2)) @ left
        forward, backward = _product(matrix, right), _product(matrix.T, left)
        block = left @ forward.swapaxes(1, 2)
        right_residual = forward - block.swapaxes(1, 2) @ right
        left_residual = backward - block @ left
        parts = (right_residual, left_residual, left)
        norms = [np.sqrt(np.einsum("pkm,pkm->p", part, part)) for part in parts]
        residual = np.maximum(norms[0], norms[1] / norms[2]) / np.abs(matrix.data).max()
        return cls(right, left, block, right_residual, left_residual, residual)

    @property
    def pairs(self) -> ComplexPairs:
        """The complex pairs among the eigenvalues, λ_r ascending, |u| = 1 and vᴴu = 1."""
        (a, b), (c, d) = np.moveaxis(self.block, 0, -1)
        values = 0.5 * (a + d) + 0.5j * np.sqrt(np.maximum(-((a - d) ** 2) - 4.0 * b * c, 0.0))
        pairs = values.imag > REAL_TOLERANCE
        values, block = values[pairs], self.block[pairs]
        right = block_eigenvectors(block, values)
        left = block_eigenvectors(block.swapaxes(1, 2), values.conj())
        u = np.einsum("pkm,pk->mp", self.right[pairs], right)
        return select_pairs(values, u, np.einsum("pkm,pk->mp", self.left[pairs], left))


def block_eigenvectors(block: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Eigenvectors (P, 2) of norm 1 of blocks (P, 2, 2): the longer column of adj(B − λ).

    Where B = λ both columns are zero and the first unit vector is taken.
    """
    (a, b), (c, d) = np.moveaxis(block, 0, -1)
    columns = np.array([[values - d, c], [b, values - a]])
    lengths = np.linalg.norm(columns, axis=1)
    longest, each = lengths.argmax(axis=0), np.arange(len(values))
    vectors, length = columns[longest, :, each], lengths[longest, each][:, None]
    return np.where(length > 0.0, vectors / np.where(length > 0.0, length, 1.0), [1.0, 0.0])


def orthonormal(vectors: np.ndarray) -> np.ndarray:
    """Orthonormal bases of the planes of two rows each, (P, 2, M): Gram-Schmidt, twice."""
    one, two = vectors[:, 0], vectors[:, 1]
    one = one / np.linalg.norm(one, axis=1, keepdims=True)
    for _ in range(2):
        two = two - one * np.einsum("pm,pm->p", one, two)[:, None]
        two = two / np.linalg.norm(two, axis=1, keepdims=True)
    return np.stack([one, two], axis=1)


def _product(matrix: sparse.csr_array, vectors: np.ndarray) -> np.ndarray:
    """K times every row of vectors (P, 2, M)."""
    return np.reshape((matrix @ vectors.reshape(-1, vectors.shape[2]).T).T, vectors.shape)
