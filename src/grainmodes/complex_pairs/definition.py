"""Complex pairs of eigenvalues and what travels with them: C, Sec. III A and B.

    M q̈ = −J q,   K = M^(−1/2) J M^(−1/2),   K u = λ u,   q = M^(−1/2) u                 C (9)-(11)
    λ = λ_r ± iλ_i,   ω_r + iω_i = √λ,   q(t) = q(0) e^{ω_i t} sin(ω_r t)               C (12), (13)

K has the eigenvalues of M⁻¹J and is symmetric where J is. Where two eigenvalues meet, their
eigenvectors become parallel and 1/|vᴴu|, by which an error of K grows into one of λ, diverges. It
is the condition of an eigenvalue and stands beside it everywhere.

| symbol           | name      | shape, type     |
| ---------------- | --------- | --------------- |
| K                | matrix    | (3N', 3N')      |
| λ, λ_i > 0       | value     | (P,) complex    |
| u, of norm 1     | right     | (3N, P) complex |
| v, with vᴴu = 1  | left      | (3N, P) complex |
| 1/|vᴴu|, norms 1 | condition | (P,)            |

N' of the N grains carry load; the vectors are zero on the others.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from grainmodes.response.stability import REAL, asymmetry

ROUNDING = 1e-14
"""max|K − Kᵀ| / max|K| of a symmetric J."""


class Loaded(NamedTuple):
    """K (3N', 3N') of the N' grains that carry load, with its zero modes (3N', 2), orthonormal.

    `held`: (N,) bool, which grains they are.
    """

    matrix: sparse.csr_array
    null: np.ndarray
    held: np.ndarray


class Pairs(NamedTuple):
    """Complex pairs of a state, λ_r ascending; the other of each is its conjugate."""

    value: np.ndarray
    right: np.ndarray
    left: np.ndarray

    @property
    def condition(self) -> np.ndarray:
        """Condition of every eigenvalue, (P,), at least 1."""
        return np.linalg.norm(self.left, axis=0)

    @property
    def growth(self) -> np.ndarray:
        """ω_i, (P,), in 1/t0: C (12)."""
        return np.sqrt(self.value).imag


def translations(mass: np.ndarray) -> np.ndarray:
    """The two zero modes M^(1/2) (1, 0, 0), M^(1/2) (0, 1, 0) of K, (3N, 2), orthonormal."""
    null = np.zeros((3 * len(mass), 2))
    null[0::3, 0] = null[1::3, 1] = np.sqrt(mass / mass.sum())
    return null


def dense_pairs(matrix: sparse.csr_array) -> Pairs:
    """Every complex pair by LAPACK: the definition.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    value, left, right = dense_eigenpairs(matrix)
    return selected(value, right, left)


def dense_eigenpairs(matrix: sparse.csr_array) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eigenvalues (M,) complex, left and right vectors (M, M) by LAPACK.

    A K that is symmetric but for rounding has real ones, found in a third of the time.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    if asymmetry(matrix.tocsc()) < ROUNDING:
        value, vectors = scipy.linalg.eigh(matrix.toarray(), overwrite_a=True, driver="evd")
        return value.astype(complex), vectors, vectors
    return scipy.linalg.eig(matrix.toarray(), left=True, overwrite_a=True)


def selected(value: np.ndarray, right: np.ndarray, left: np.ndarray) -> Pairs:
    """The complex pairs among eigenvalues (M,) with vectors (n, M), scaled to vᴴu = 1."""
    upper = np.flatnonzero(value.imag > REAL)
    upper = upper[np.argsort(value.real[upper], kind="stable")]
    right = right[:, upper] / np.linalg.norm(right[:, upper], axis=0)
    products = np.einsum("np,np->p", left[:, upper].conj(), right)
    return Pairs(value[upper], right, left[:, upper] / products.conj())


def quotients(matrix: sparse.csr_array, pairs: Pairs) -> Pairs:
    """The pairs with λ = vᴴ K u, whose error is the square of that of the vectors."""
    return pairs._replace(value=np.einsum("np,np->p", pairs.left.conj(), matrix @ pairs.right))


def on_all_grains(vectors: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Vectors (3N', P) of the grains that carry load on all N, (3N, P)."""
    whole = np.zeros((3 * len(held), vectors.shape[1]), vectors.dtype)
    whole[np.repeat(held, 3)] = vectors
    return whole
