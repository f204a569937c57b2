"""What touches what in a packing, what the springs between remember, and which grains are rattlers.

| symbol            | name                    | shape, type          | unit    |
| ----------------- | ----------------------- | -------------------- | ------- |
| n_ij = r_ij/r_ij  | normal                  | (C, 2) float64       | 1       |
| r_ij, ξ_ij        | distance, overlap       | (C,) float64         | d       |
| s_ij, ξ_T,ij      | spring_state | (C,) float64 or None | d       |

Friction that was never loaded is `None`: it is neither stored nor computed.
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
        """t = (n_y, −n_x), shape (C, 2)."""
        return np.stack([self.normal[:, 1], -self.normal[:, 0]], axis=1)

    @property
    def displacement(self) -> np.ndarray:
        """s of every contact, zero where friction was never loaded; shape (C,)."""
        s = self.spring_state
        return np.zeros(len(self.i)) if s is None else s

    def among(self, keep: np.ndarray) -> Contacts:
        """The contacts between the grains of a (N,) mask, in their new numbers."""
        if keep.all():
            return self
        held, i, j = _among(keep, self.i, self.j)
        s = self.spring_state
        return Contacts(
            i,
            j,
            self.normal[held],
            self.distance[held],
            self.overlap[held],
            None if s is None else s[held],
        )


@dataclass(frozen=True)
class History:
    """Contacts with their tangential displacement s: pairs i > j sorted by (i, j)."""

    i: np.ndarray
    j: np.ndarray
    spring_state: np.ndarray

    @property
    def key(self) -> np.ndarray:
        """One number for every pair of grains, ascending, (C,) int64: see `pair_key`."""
        return pair_key(self.i, self.j)

    @classmethod
    def from_pairs(cls, i: np.ndarray, j: np.ndarray, spring_state: np.ndarray) -> History:
        """The history of pairs in any order; s does not change sign when i and j are swapped."""
        high, low = np.maximum(i, j), np.minimum(i, j)
        order = np.lexsort((low, high))
        return cls(high[order], low[order], np.asarray(spring_state)[order])

    def among(self, keep: np.ndarray) -> History:
        """The contacts between the grains of a (N,) mask, in their new numbers."""
        held, i, j = _among(keep, self.i, self.j)
        return History(i, j, self.spring_state[held])


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
    """Which pairs stand between the grains of a mask, and these with the grains renumbered."""
    held = keep[i] & keep[j]
    number = np.cumsum(keep, dtype=np.int32) - 1
    return held, number[i[held]], number[j[held]]
