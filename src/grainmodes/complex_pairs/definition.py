"""Complex pairs of eigenvalues and what belongs to them: C, Sec. III A and B.

    M q̈ = −J q,   K = M^(−1/2) J M^(−1/2),   K u = λ u,   q = M^(−1/2) u                 C (9)-(11)
    λ = λ_r ± iλ_i,   ω_r + iω_i = √λ,   q(t) = q(0) e^{ω_i t} sin(ω_r t)               C (12), (13)

K has the eigenvalues of M⁻¹J and is symmetric where J is. Where two eigenvalues meet, their
eigenvectors become parallel, and the condition 1/|vᴴu| of the eigenvalue diverges. An error of K
grows by this factor into an error of λ, so the condition stands beside every eigenvalue.

| symbol           | name      | shape, type, unit                     |
| ---------------- | --------- | ------------------------------------- |
| K                | matrix    | (3N', 3N') sparse, k_N d^(1/2)/m      |
| λ, λ_i > 0       | value     | (P,) complex128, k_N d^(1/2)/m        |
| u, of norm 1     | right     | (3N, P) complex128                    |
| v, with vᴴu = 1  | left      | (3N, P) complex128                    |
| 1/|vᴴu|, norms 1 | condition | (P,) float64                          |

N' of the N grains carry load, the backbone. The vectors are zero on the others.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from grainmodes.linalg.failures import finite
from grainmodes.packing.state import zero_on_rattlers
from grainmodes.response.stability import REAL_TOLERANCE, asymmetry

SYMMETRY_TOLERANCE = 1e-14
"""max|K − Kᵀ| / max|K| up to which K counts as symmetric."""


class DynamicalMatrix(NamedTuple):
    """K of the backbone.

    Attributes:
        matrix: K, (3N', 3N').
        null: its zero modes on both sides, (3N', Z), orthonormal.
        backbone: which of the N grains carry load, (N,) bool.
    """

    matrix: sparse.csr_array
    null: np.ndarray
    backbone: np.ndarray


class ComplexPairs(NamedTuple):
    """The complex pairs of a state, λ_r ascending. Each stands for λ and its conjugate."""

    value: np.ndarray
    right: np.ndarray
    left: np.ndarray

    @property
    def condition(self) -> np.ndarray:
        """Condition of every eigenvalue, (P,), at least 1."""
        return np.asarray(np.linalg.norm(self.left, axis=0))

    @property
    def growth(self) -> np.ndarray:
        """ω_i, (P,), in 1/t0: C (12)."""
        return np.imag(np.sqrt(self.value))


def translations(mass: np.ndarray) -> np.ndarray:
    """The two zero modes M^(1/2) (1, 0, 0), M^(1/2) (0, 1, 0) of K, (3N, 2), orthonormal."""
    null = np.zeros((3 * len(mass), 2))
    null[0::3, 0] = null[1::3, 1] = np.sqrt(mass / mass.sum())
    return null


def dense_pairs(matrix: sparse.csr_array) -> ComplexPairs:
    """All complex pairs of K (M, M) by LAPACK: the definition.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    value, left, right = dense_eigenpairs(matrix)
    return select_pairs(value, right, left)


def dense_eigenpairs(matrix: sparse.csr_array) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eigenvalues (M,) complex, left and right vectors (M, M) by LAPACK.

    A K that is symmetric up to rounding has real ones, which take a third of the time.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    if asymmetry(matrix.tocsc()) < SYMMETRY_TOLERANCE:
        value, vectors = scipy.linalg.eigh(finite(matrix.toarray()), overwrite_a=True, driver="evd")
        return value.astype(complex), vectors, vectors
    value, left, right = scipy.linalg.eig(finite(matrix.toarray()), left=True, overwrite_a=True)
    return value, left, right


def select_pairs(value: np.ndarray, right: np.ndarray, left: np.ndarray) -> ComplexPairs:
    """The complex pairs among eigenvalues (M,) with vectors (n, M), scaled to vᴴu = 1."""
    upper = np.flatnonzero(value.imag > REAL_TOLERANCE)
    upper = upper[np.argsort(value.real[upper], kind="stable")]
    right = right[:, upper] / np.linalg.norm(right[:, upper], axis=0)
    products = np.einsum("np,np->p", left[:, upper].conj(), right)
    return ComplexPairs(value[upper], right, left[:, upper] / products.conj())


def with_rayleigh_quotients(matrix: sparse.csr_array, pairs: ComplexPairs) -> ComplexPairs:
    """The pairs with their two-sided Rayleigh quotients λ = vᴴ K u.

    The error of the quotient is of the order of the product of the errors of u and v.
    """
    value = np.einsum("np,np->p", pairs.left.conj(), matrix @ pairs.right)
    return pairs._replace(value=value)


def vectors_on_all_grains(vectors: np.ndarray, backbone_mask: np.ndarray) -> np.ndarray:
    """Vectors (3N', P) of the backbone on all N grains, (3N, P); 0 on rattlers."""
    rows, columns = vectors.shape
    grains = zero_on_rattlers(vectors.reshape(rows // 3, 3, columns), backbone_mask)
    return grains.reshape(3 * len(backbone_mask), columns)
