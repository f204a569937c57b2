"""Many planes of two eigenvectors at once, with what is missing to make each of them invariant.

A plane is spanned by R on the right and L on the left, Lᵀ R = 1, and K on it is B = Lᵀ K R. It is
invariant where the residuals are 0,

    K R − R B = 0,   Kᵀ L − L Bᵀ = 0

and λ, the eigenvalues of B, are those of K then; elsewhere they are right to the product of both.
With B k = λ k and Bᵀ m = λ* m a pair is u = R k, v = L m.

| symbol         | name         | shape                                          |
| -------------- | ------------ | ---------------------------------------------- |
| R, orthonormal | right        | (K, 2, M)                                      |
| L              | left         | (K, 2, M)                                      |
| B              | block        | (K, 2, 2)                                      |
| K R − R B      | missing      | (K, 2, M)                                      |
| Kᵀ L − L Bᵀ    | missing_left | (K, 2, M)                                      |
| the larger one | residual     | (K,), in units of max|K|; of L in those of |L| |
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.definition import Pairs
from grainmodes.response.stability import REAL


class Couples(NamedTuple):
    """Planes of two eigenvectors each."""

    right: np.ndarray
    left: np.ndarray
    block: np.ndarray
    missing: np.ndarray
    missing_left: np.ndarray
    residual: np.ndarray

    @classmethod
    def of(cls, matrix: sparse.csr_array, right: np.ndarray, left: np.ndarray) -> Couples:
        """The planes of real vectors (K, 2, M) as they are; they need no scale."""
        right, left = orthonormal(right), orthonormal(left)
        left = np.linalg.inv(left @ right.swapaxes(1, 2)) @ left
        forward, back = _applied(matrix, right), _applied(matrix.T, left)
        block = left @ forward.swapaxes(1, 2)
        missing, missing_left = forward - block.swapaxes(1, 2) @ right, back - block @ left
        residual = np.maximum(_size(missing), _size(missing_left) / _size(left))
        residual /= np.abs(matrix.data).max()
        return cls(right, left, block, missing, missing_left, residual)

    def at(self, these: np.ndarray) -> Couples:
        """Some of them."""
        return Couples(*(of[these] for of in self))

    def with_those(self, these: np.ndarray, others: Couples) -> Couples:
        """Others in the places of some, (K,) bool."""
        if these.all():
            return others
        for mine, new in zip(self, others, strict=True):
            mine[these] = new
        return self

    @property
    def middle(self) -> np.ndarray:
        """(λ1 + λ2)/2, (K,)."""
        return 0.5 * np.trace(self.block, axis1=1, axis2=2)

    @property
    def pairs(self) -> Pairs:
        """The complex pairs among them, u of norm 1, vᴴu = 1."""
        (a, b), (c, d) = np.moveaxis(self.block, 0, -1)
        imaginary = 0.5 * np.sqrt(np.maximum(-((a - d) ** 2) - 4.0 * b * c, 0.0))
        (those,) = np.nonzero(imaginary > REAL)
        those = those[np.argsort(self.middle[those], kind="stable")]
        values = (self.middle + 1j * imaginary)[those]
        block = self.block[those]
        right, left = kernels(block, values), kernels(block.swapaxes(1, 2), values.conj())
        left /= np.einsum("kp,kp->k", left, right.conj())[:, None]
        return Pairs(values, _on(self.right[those], right), _on(self.left[those], left))


def kernels(block: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Eigenvectors (K, 2) of norm 1 of 2 × 2 blocks (K, 2, 2), the longer column of adj(B − λ)."""
    (a, b), (c, d) = np.moveaxis(block, 0, -1)
    columns = np.array([[values - d, c + 0j], [b + 0j, values - a]])
    lengths = np.linalg.norm(columns, axis=1)
    longest, each = lengths.argmax(axis=0), np.arange(len(values))
    return columns[longest, :, each] / lengths[longest, each][:, None]


def orthonormal(planes: np.ndarray) -> np.ndarray:
    """Orthonormal bases (K, 2, M) of the planes of two rows each: Gram-Schmidt, twice."""
    one, two = planes[:, 0], planes[:, 1]
    one = one / np.linalg.norm(one, axis=1, keepdims=True)
    for _ in range(2):
        two = two - one * np.einsum("km,km->k", one, two)[:, None]
        two = two / np.linalg.norm(two, axis=1, keepdims=True)
    return np.stack([one, two], axis=1)


def _on(planes: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
    """Vectors (M, K) with coordinates (K, 2) on planes."""
    return np.einsum("kpm,kp->mk", planes, coordinates)


def _applied(matrix: sparse.csr_array, planes: np.ndarray) -> np.ndarray:
    """K of every row of planes (K, 2, M)."""
    return (matrix @ planes.reshape(-1, planes.shape[2]).T).T.reshape(planes.shape)


def _size(planes: np.ndarray) -> np.ndarray:
    return np.sqrt(np.einsum("kpm,kpm->k", planes, planes))
