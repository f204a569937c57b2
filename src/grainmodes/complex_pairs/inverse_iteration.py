"""The invariant subspace of two modes by inverse iteration: C, Sec. III C.

Where two eigenvalues meet, λ1 = λ2, K has one eigenvector instead of two, and the condition of each
eigenvalue by itself is infinite. The invariant subspace of both and its block B, the 2 × 2 matrix
of K on it, stay smooth, and so do

    λ1 + λ2 = tr B,   D = (λ1 − λ2)² = (tr B)² − 4 det B                                    C (19)

D changes sign where the two meet, and |λ1 − λ2| = |D|^(1/2). Everything near an exceptional point
is therefore computed from the subspace. It is improved from both sides until its residual is small,

    R ← (K − σ)⁻¹ R,   L ← (K − σ)⁻ᵀ L,   B = Lᵀ K R with Lᵀ R = 1

with one shift σ = tr B / 2 for the whole subspace where the two eigenvalues are close, and with
σ = λ1, λ2 for each eigenvector elsewhere, where another mode may lie between them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.invariant_subspaces import Subspaces, block_eigenvectors
from grainmodes.linalg.general_shift import GeneralShift

MAX_ITERATIONS = 12
"""Four times what a subspace needs that has turned by a tenth."""

INVARIANCE_TOLERANCE = 1e-12
"""Residual of an invariant subspace, in units of max|K|."""

COMMON_SHIFT_GAP = 1e-5
"""|λ1 − λ2|, in units of max|K|, up to which both eigenvectors are iterated with one shift."""


class InvariantSubspace(NamedTuple):
    """The subspace of two modes.

    Attributes:
        right: R, (M, 2), orthonormal.
        left: L, (M, 2), Lᵀ R = 1.
        block: B, (2, 2).
        residual: the larger of |K R − R B| and |Kᵀ L − L Bᵀ| / |L|, in units of max|K|.
    """

    right: np.ndarray
    left: np.ndarray
    block: np.ndarray
    residual: float

    @property
    def sum(self) -> float:
        """λ1 + λ2."""
        return float(np.trace(self.block))

    @property
    def discriminant(self) -> float:
        """D = (λ1 − λ2)², below 0 for a complex pair."""
        (a, b), (c, d) = self.block
        return float((a - d) ** 2 + 4.0 * b * c)

    @property
    def is_pair(self) -> bool:
        """Whether the two eigenvalues are a complex pair."""
        return self.discriminant < 0.0

    @property
    def values(self) -> np.ndarray:
        """λ1 and λ2, (2,) complex128; the first one is the larger, or has λ_i > 0."""
        root = np.sqrt(complex(self.discriminant))
        return 0.5 * (self.sum + np.array([root, -root]))

    @property
    def vectors(self) -> np.ndarray:
        """u1 and u2, (M, 2) complex128, of norm 1; the same one twice where λ1 = λ2."""
        return np.asarray(self.right @ _eigenvectors(self.block, self.values))

    @property
    def left_vectors(self) -> np.ndarray:
        """v1 and v2, (M, 2) complex128: vᴴ K = λ vᴴ."""
        return np.asarray(self.left @ _eigenvectors(self.block.T, self.values.conj()))

    @property
    def product(self) -> float:
        """C's scalar product |Σ u1_j u2_j| of the two eigenvectors of norm 1, not conjugated.

        It is 1 for a complex pair and 0 where K is symmetric.
        """
        one, two = _eigenvectors(self.block, self.values).T
        return float(abs(one @ two))

    @property
    def condition(self) -> float:
        """Condition 1/|vᴴu| of λ1, which is that of λ2; infinite where the two meet."""
        value = self.values[:1]
        right = _eigenvectors(self.block, value)[:, 0]
        left = _eigenvectors(self.block.T, value.conj())[:, 0]
        overlap = abs(left.conj() @ right)
        return float(np.linalg.norm(self.left @ left) / overlap) if overlap else np.inf

    def overlap_with(self, other: InvariantSubspace) -> float:
        """Projector overlap with another subspace, 0 to 1: how much of this one lies in it."""
        return float(np.linalg.norm(other.left.T @ self.right) / np.sqrt(2.0))


def subspace_spanned_by(
    matrix: sparse.csr_array, right: np.ndarray, left: np.ndarray
) -> InvariantSubspace:
    """The subspace of real vectors (M, 2) of any norm as it is, with its residual for K (M, M)."""
    found = Subspaces.spanned_by(matrix, right.T[None], left.T[None])
    residual = float(found.residual[0])
    return InvariantSubspace(found.right[0].T, found.left[0].T, found.block[0], residual)


def nearest_subspace(matrix: sparse.csr_array, start: InvariantSubspace) -> InvariantSubspace:
    """The invariant subspace of K (M, M) to which inverse iteration leads from `start`.

    It is invariant if its residual is `INVARIANCE_TOLERANCE` at most; the caller checks this.

    Raises:
        ArithmeticError: the iteration broke down.
    """
    now, factors = subspace_spanned_by(matrix, start.right, start.left), GeneralShift(matrix)
    common_shift_gap = COMMON_SHIFT_GAP * np.abs(matrix.data).max()
    for _ in range(MAX_ITERATIONS):
        if now.residual <= INVARIANCE_TOLERANCE:
            break
        now = subspace_spanned_by(matrix, *_iterate(factors, now, common_shift_gap))
        if not np.isfinite(now.residual):
            raise ArithmeticError("inverse iteration: expected a finite residual, got NaN")
    return now


def _iterate(
    factors: GeneralShift, now: InvariantSubspace, common_shift_gap: float
) -> tuple[np.ndarray, np.ndarray]:
    """Right and left vectors (M, 2) after one step of inverse iteration."""
    if np.sqrt(abs(now.discriminant)) <= common_shift_gap:
        factors.factor_at(0.5 * now.sum)
        return factors.solve(now.right), factors.solve_transposed(now.left)
    pair = now.is_pair
    values = now.values[:1] if pair else now.values.real
    rights = now.right @ _eigenvectors(now.block, values)
    lefts = now.left @ _eigenvectors(now.block.T, values)
    right, left = [], []
    for place, value in enumerate(values):
        factors.factor_at(value)
        right.append(factors.solve(rights[:, place]))
        left.append(factors.solve_transposed(lefts[:, place]))
    if pair:
        right, left = ([vectors[0].real, vectors[0].imag] for vectors in (right, left))
    return np.stack(right, axis=1), np.stack(left, axis=1)


def _eigenvectors(block: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Eigenvectors of norm 1 of one block (2, 2), one column for each of its `values` (K,)."""
    return block_eigenvectors(np.broadcast_to(block, (len(values), 2, 2)), values).T
