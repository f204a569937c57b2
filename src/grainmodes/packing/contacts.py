"""Touching pairs of a packing and the states of the springs between them.

| symbol            | name              | shape, type          | unit                |
| ----------------- | ----------------- | -------------------- | ------------------- |
| i > j             | i, j              | (C,) int32           | 1                   |
| n_ij = r_ij/r_ij  | normal            | (C, 2) float64       | 1                   |
| r_ij, ξ_ij        | distance, overlap | (C,) float64         | d                   |
| s_ij, ξ_T,ij      | spring_state      | (C,) float64 or None | d                   |
| h_ij              | spring_state      | (C,) float64 or None | k_N d^(3/2) (Hertz) |

Each law states whether its springs remember a displacement s or a force h (`kernels.laws`). If
friction was never loaded, the spring states are None: they are neither stored nor computed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Contacts:
    """Touching pairs, i > j, sorted by (i, j); n points from j to i."""

    i: np.ndarray
    j: np.ndarray
    normal: np.ndarray
    distance: np.ndarray
    overlap: np.ndarray
    spring_state: np.ndarray | None = None

    @property
    def key(self) -> np.ndarray:
        """One number for every pair of grains, ascending, (C,) int64: see `pair_key`."""
        return pair_key(self.i, self.j)

    @property
    def tangent(self) -> np.ndarray:
        """t = (n_y, −n_x), (C, 2) float64."""
        return np.stack([self.normal[:, 1], -self.normal[:, 0]], axis=1)

    @property
    def springs(self) -> np.ndarray:
        """Spring state of every contact, (C,) float64; 0 where friction was never loaded."""
        s = self.spring_state
        return np.zeros(len(self.i)) if s is None else s

    def among(self, keep: np.ndarray) -> Contacts:
        """The contacts between the grains of a mask (N,) bool, in their new numbers."""
        if keep.all():
            return self
        between, i, j = _among(keep, self.i, self.j)
        s = self.spring_state
        return Contacts(
            i,
            j,
            self.normal[between],
            self.distance[between],
            self.overlap[between],
            None if s is None else s[between],
        )


@dataclass(frozen=True)
class History:
    """Spring states of contacts: pairs i > j (C,) int32, sorted by (i, j), states (C,) float64."""

    i: np.ndarray
    j: np.ndarray
    spring_state: np.ndarray

    @property
    def key(self) -> np.ndarray:
        """One number for every pair of grains, ascending, (C,) int64: see `pair_key`."""
        return pair_key(self.i, self.j)

    @classmethod
    def from_pairs(cls, i: np.ndarray, j: np.ndarray, spring_state: np.ndarray) -> History:
        """The history of pairs in any order, all arrays (C,).

        A spring state does not change its sign when i and j are exchanged.
        """
        high, low = np.maximum(i, j), np.minimum(i, j)
        order = np.lexsort((low, high))
        return cls(high[order], low[order], np.asarray(spring_state)[order])

    def among(self, keep: np.ndarray) -> History:
        """The springs between the grains of a mask (N,) bool, in their new numbers."""
        between, i, j = _among(keep, self.i, self.j)
        return History(i, j, self.spring_state[between])


def pair_key(i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """2³² i + j of pairs (i, j), (C,) int64: ascending where the pairs are sorted by (i, j)."""
    return i.astype(np.int64) << 32 | j


def pairs_of_key(key: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Grains (i, j) of the pairs with these keys, (C,) int64 each."""
    return key >> 32, key & (2**32 - 1)


def contact_changes(before: Contacts, after: Contacts) -> int:
    """Number of pairs that touch in one state but not in the other, of the same grains."""
    return len(np.setxor1d(before.key, after.key, assume_unique=True))


def _among(
    keep: np.ndarray, i: np.ndarray, j: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Which pairs lie between the grains of a mask, and i and j of these in the new numbers."""
    between = keep[i] & keep[j]
    number = np.cumsum(keep, dtype=np.int32) - 1
    return between, number[i[between]], number[j[between]]
