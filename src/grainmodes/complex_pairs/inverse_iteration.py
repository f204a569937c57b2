"""The plane of two eigenvectors, by inverse iteration from both sides.

Two eigenvalues that meet, λ1 = λ2, leave K one eigenvector instead of two: each of them alone has
an infinite condition. Their plane, and the 2 × 2 block B that K is on it, stay smooth, and so are

    λ1 + λ2 = tr B,   D = (λ1 − λ2)² = (tr B)² − 4 det B                                    C (19)

D changes sign where the two meet; |λ1 − λ2| = |D|^(1/2). Everything near an exceptional point is
therefore computed from the plane. It is improved until it stands still,

    R ← (K − σ)⁻¹ R,   L ← (K − σ)⁻ᵀ L,   B = Lᵀ K R with Lᵀ R = 1

with σ = tr B / 2 for the whole plane where the two are `CLOSE`, and with σ = λ1, λ2 for each
eigenvector elsewhere, where another mode may lie between them. The scalar product of the two
eigenvectors is C's, |Σ u¹_j u²_j| with norms 1 and no conjugation: 1 for a complex pair, 0 where K
is symmetric.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.invariant_subspaces import Subspaces, block_eigenvectors
from grainmodes.linalg.general_shift import Shifted

MOST = 12
"""Iterations: four times what a plane needs that has turned by a tenth."""

SETTLED = 1e-12
"""Residual, in units of max|K|, at which a plane stands still."""

CLOSE = 1e-5
"""|λ1 − λ2|, in units of max|K|, up to which the two eigenvectors are not told apart."""


class Plane(NamedTuple):
    """An invariant plane: R (M, 2) orthonormal, L (M, 2) with Lᵀ R = 1, B (2, 2).

    `residual` is the larger of |K R − R B| and |Kᵀ L − L Bᵀ| / |L|, in units of max|K|.
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
        """λ1 and λ2, (2,) complex; the first one is the larger, or has λ_i > 0."""
        root = np.sqrt(complex(self.discriminant))
        return 0.5 * (self.sum + np.array([root, -root]))

    @property
    def vectors(self) -> np.ndarray:
        """u1 and u2, (M, 2) complex, of norm 1; the same one twice where λ1 = λ2."""
        return self.right @ _kernels(self.block, self.values)

    @property
    def left_vectors(self) -> np.ndarray:
        """v1 and v2, (M, 2) complex: vᴴ K = λ vᴴ."""
        return self.left @ _kernels(self.block.T, self.values.conj())

    @property
    def product(self) -> float:
        """C's scalar product |Σ u1_j u2_j| of the two eigenvectors."""
        one, two = _kernels(self.block, self.values).T
        return float(abs(one @ two))

    @property
    def condition(self) -> float:
        """Condition 1/|vᴴu| of λ1, which is that of λ2; infinite where the two meet."""
        value = self.values[:1]
        right = _kernels(self.block, value)[:, 0]
        left = _kernels(self.block.T, value.conj())[:, 0]
        overlap = abs(left.conj() @ right)
        return float(np.linalg.norm(self.left @ left) / overlap) if overlap else np.inf

    def part_of(self, other: Plane) -> float:
        """How much of this plane lies in another one, 0 to 1: the rest lies in other modes."""
        return float(np.linalg.norm(other.left.T @ self.right) / np.sqrt(2.0))


def plane_of(matrix: sparse.csr_array, right: np.ndarray, left: np.ndarray) -> Plane:
    """The plane of real vectors (M, 2) as it is, with its residual; they need no scale."""
    found = Subspaces.spanned_by(matrix, right.T[None], left.T[None])
    return Plane(found.right[0].T, found.left[0].T, found.block[0], float(found.residual[0]))


def plane_near(matrix: sparse.csr_array, start: Plane) -> Plane:
    """The invariant plane of K that a plane of a similar matrix leads to.

    Its residual tells whether it is one: `SETTLED` at most.

    Raises:
        ArithmeticError: the iteration broke down.
    """
    now, factors = plane_of(matrix, start.right, start.left), Shifted(matrix)
    for _ in range(MOST):
        if now.residual <= SETTLED:
            break
        now = plane_of(matrix, *_improved(factors, now, CLOSE * np.abs(matrix.data).max()))
        if not np.isfinite(now.residual):
            raise ArithmeticError("the plane of two eigenvectors was lost")
    return now


def _improved(factors: Shifted, now: Plane, close: float) -> tuple[np.ndarray, np.ndarray]:
    """Vectors (M, 2) on both sides after one step of inverse iteration."""
    if np.sqrt(abs(now.discriminant)) <= close:
        factors.to(0.5 * now.sum)
        return factors.solve(now.right), factors.solve_transposed(now.left)
    pair = now.is_pair
    values = now.values[:1] if pair else now.values.real
    rights = now.right @ _kernels(now.block, values)
    lefts = now.left @ _kernels(now.block.T, values)
    right, left = [], []
    for place, value in enumerate(values):
        factors.to(value)
        right.append(factors.solve(rights[:, place]))
        left.append(factors.solve_transposed(lefts[:, place]))
    if pair:
        right, left = ([of[0].real, of[0].imag] for of in (right, left))
    return np.stack(right, axis=1), np.stack(left, axis=1)


def _kernels(block: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Eigenvectors of norm 1 of one block (2, 2), one column for each of its `values` (K,)."""
    return block_eigenvectors(np.broadcast_to(block, (len(values), 2, 2)), values).T
