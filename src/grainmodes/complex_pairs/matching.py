"""Which complex pair of one state is which of the next, by the overlap of their subspaces.

A pair spans a real plane, Re u and Im u, with a right basis R and a left basis L, Lᵀ R = 1. The
projector R Lᵀ of the old pair takes the part |Lᵀ R'|/√2 out of the plane R' of a new one. This
overlap is 1 for the same plane and, unlike the product of right eigenvectors, 0 for every other
plane of the same matrix. Two pairs are the same one if each has its largest overlap with the other
and both overlaps are above `MIN_PROJECTOR_OVERLAP`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.complex_pairs.definition import ComplexPairs
from grainmodes.complex_pairs.invariant_subspaces import orthonormal

MIN_PROJECTOR_OVERLAP = 0.5
"""Projector overlap above which two pairs are the same."""


class PairProjectors(NamedTuple):
    """R, orthonormal, and Lᵀ of every pair, (P, 2, n) float32: they are only compared."""

    right: np.ndarray
    left: np.ndarray

    @classmethod
    def from_pairs(cls, pairs: ComplexPairs) -> PairProjectors:
        """The projectors on the planes of complex pairs."""
        right, left = (
            orthonormal(np.stack([vectors.real.T, vectors.imag.T], axis=1))
            for vectors in (pairs.right, pairs.left)
        )
        left = np.linalg.inv(left @ right.swapaxes(1, 2)) @ left
        return cls(right.astype(np.float32), left.astype(np.float32))


def match_pairs(old: PairProjectors, new: PairProjectors) -> list[tuple[int, int]]:
    """Places (old, new) of the pairs that two states have in common."""
    if not len(old.right) or not len(new.right):
        return []
    overlap = np.minimum(projector_overlap(old, new), projector_overlap(new, old).T)
    forth, back = overlap.argmax(axis=1), overlap.argmax(axis=0)
    return [
        (i, j)
        for i, j in enumerate(forth.tolist())
        if back[j] == i and overlap[i, j] > MIN_PROJECTOR_OVERLAP
    ]


def projector_overlap(projectors: PairProjectors, others: PairProjectors) -> np.ndarray:
    """Part of every plane of `others` that the projectors keep, (P, P'), 0 to 1."""
    size = projectors.left.shape[2]
    within = projectors.left.reshape(-1, size) @ others.right.reshape(-1, size).T
    squares = (within**2).reshape(len(projectors.left), 2, -1, 2)
    return np.asarray(np.sqrt(0.5 * squares.sum(axis=(1, 3))))
