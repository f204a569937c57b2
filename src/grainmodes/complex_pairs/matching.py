"""Which complex pair of one state is which of the next.

A pair spans a real plane, Re u and Im u. With the left plane L of the old pair, Lᵀ R = 1, the part
of the new plane R' that lies in the old one is |Lᵀ R'|/√2. It is 1 for the same plane and, unlike
the product of right eigenvectors, 0 for every other plane of the same matrix. Two pairs are the
same one if each has its largest part in the other and both parts are above `SAME`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.complex_pairs.definition import ComplexPairs
from grainmodes.complex_pairs.invariant_subspaces import orthonormal

SAME = 0.5
"""Part of the new plane in the old one from which two pairs are the same."""


class Planes(NamedTuple):
    """R and Lᵀ with Lᵀ R = 1, (P, 2, n) in single precision: they are only compared."""

    right: np.ndarray
    left: np.ndarray

    @classmethod
    def of(cls, pairs: ComplexPairs) -> Planes:
        """The planes of pairs, R orthonormal."""
        right, left = (
            orthonormal(np.stack([of.real.T, of.imag.T], axis=1))
            for of in (pairs.right, pairs.left)
        )
        left = np.linalg.inv(left @ right.swapaxes(1, 2)) @ left
        return cls(right.astype(np.float32), left.astype(np.float32))


def matched(old: Planes, new: Planes) -> list[tuple[int, int]]:
    """Places (old, new) of the pairs that two states have in common."""
    if not len(old.right) or not len(new.right):
        return []
    part = np.minimum(parts(old, new), parts(new, old).T)
    forth, back = part.argmax(axis=1), part.argmax(axis=0)
    return [(i, j) for i, j in enumerate(forth.tolist()) if back[j] == i and part[i, j] > SAME]


def parts(of: Planes, other: Planes) -> np.ndarray:
    """Part of the planes of `other` in those `of`, (P, P')."""
    within = _rows(of.left) @ _rows(other.right).T
    squares = (within**2).reshape(len(of.left), 2, -1, 2)
    return np.sqrt(0.5 * squares.sum(axis=(1, 3)))


def _rows(planes: np.ndarray) -> np.ndarray:
    return planes.reshape(-1, planes.shape[2])
