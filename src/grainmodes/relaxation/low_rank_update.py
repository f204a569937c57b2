"""The factors of an earlier J₀, updated for the few contacts that have changed since (Woodbury).

Most contacts hardly change from one equilibrium state to the next; a few open, close or begin to
slide. J = −Σ P K Pᵀ is a sum over contacts, where P (kN, k) places the k rows of a contact at its
grains i and j. Then

    J = J₀ + P D Pᵀ + small,      D = K₀ − K of the contacts that changed      (K = 0 where open)
    J⁻¹ f ≈ u₀ − W C⁻¹ D Pᵀ u₀,   u₀ = J₀⁻¹ f,   W = J₀⁻¹ P,   C = 1 + D Pᵀ W        (Woodbury)

det J = det J₀ det C: as contacts change, an eigenvalue of J passes zero together with one of C.

| symbol | name             | shape, type                       | unit        |
| ------ | ---------------- | --------------------------------- | ----------- |
| K      | stiffness        | (C, k, k) float64                 | k_N d^(1/2) |
| D      | stiffness_change | (c, k, k) of c changed contacts   | k_N d^(1/2) |
| W      | response         | (kN, kc) float64                  | d^(1/2)/k_N |
| C      | coupling         | (kc, kc) float64                  | 1           |
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from grainmodes.linalg.pinned_factor import PinnedFactor
from grainmodes.packing.contacts import Contacts, pairs_of_key
from grainmodes.packing.forces import SIGNS

CHANGE_THRESHOLD = 0.03
"""Change of the stiffness of a contact, relative to the largest of all stiffnesses, above which the
contact counts as changed."""

MAX_CHANGED_CONTACTS = 12
"""Number of changed contacts up to which an update is cheaper than new factors: each of them costs
k solutions."""


class BaseFactor:
    """The factors of an earlier J₀, with its contacts and, as they are needed, its responses W.

    Attributes:
        factor: the factors of J₀.

    Args:
        contacts: C contacts of J₀.
        stiffness: K of these contacts, (C, k, k).
    """

    def __init__(self, factor: PinnedFactor, contacts: Contacts, stiffness: NDArray[np.float64]):
        self.factor = factor
        self._contacts, self._stiffness = contacts, stiffness
        self._responses: dict[tuple[int, int], NDArray[np.float64]] = {}
        unchanged = LowRankUpdate(factor, contacts.i[:0], contacts.j[:0], stiffness[:0], [])
        self._latest: tuple[Contacts, LowRankUpdate | None] = contacts, unchanged

    def updated(
        self, contacts: Contacts, stiffness: Callable[[], NDArray[np.float64]]
    ) -> LowRankUpdate | None:
        """The update for other contacts between the same grains; None if too many have changed.

        The last update is returned again until a contact opens or closes.

        Args:
            stiffness: a function that returns K of these contacts, called if it is needed.
        """
        if not _same_pairs(contacts, self._latest[0]):
            self._latest = contacts, self._update(contacts, stiffness())
        return self._latest[1]

    def _update(self, contacts: Contacts, stiffness: NDArray[np.float64]) -> LowRankUpdate | None:
        i, j, change = _changed_contacts(self._contacts, self._stiffness, contacts, stiffness)
        if len(i) > MAX_CHANGED_CONTACTS:
            return None
        k = stiffness.shape[1]
        responses = [self._response(*pair, k) for pair in zip(i, j, strict=True)]
        return LowRankUpdate(self.factor, i, j, change, responses)

    def _response(self, i: int, j: int, k: int) -> NDArray[np.float64]:
        """J₀⁻¹ P of one contact, (kN, k)."""
        if (i, j) not in self._responses:
            forces = np.zeros((k, self.factor.size))
            for a in range(k):
                forces[a, k * i + a], forces[a, k * j + a] = 1.0, SIGNS[a]
            columns = [self.factor.solve(force, refined=False) for force in forces]
            self._responses[i, j] = np.stack(columns, axis=1)
        return self._responses[i, j]


class LowRankUpdate:
    """(J₀ + P D Pᵀ)⁻¹ for c contacts whose stiffness has fallen by D.

    Attributes:
        may_change_signs: whether J₀ and J may have different numbers of negative eigenvalues.

    Args:
        factor: the factors of J₀.
        i, j: (c,) the grains of the contacts.
        stiffness_change: D, (c, k, k).
        responses: W of each contact, c times (kN, k).
    """

    def __init__(
        self,
        factor: PinnedFactor,
        i: NDArray[np.integer],
        j: NDArray[np.integer],
        stiffness_change: NDArray[np.float64],
        responses: list[NDArray[np.float64]],
    ):
        self._factor, self._i, self._j = factor, i, j
        self._stiffness_change = stiffness_change
        self.may_change_signs = False
        if responses:
            response = np.concatenate(responses, axis=1)
            coupling = np.eye(response.shape[1]) + self._force_changes(response)
            values = np.linalg.eigvals(coupling)
            self.may_change_signs = bool(np.any((values.real <= 0.0) & (values.imag == 0.0)))
            self._correction = np.linalg.solve(coupling.T, response.T).T

    def solve(self, force: NDArray[np.float64]) -> NDArray[np.float64]:
        """u with (J₀ + P D Pᵀ) u = `force`, (kN,), not refined."""
        u = self._factor.solve(force, refined=False)
        if len(self._i):
            u -= self._correction @ self._force_changes(u[:, None])[:, 0]
        return u

    def _force_changes(self, u: NDArray[np.float64]) -> NDArray[np.float64]:
        """D Pᵀ u of every contact, (kc, columns), from fields u (kN, columns)."""
        k = self._stiffness_change.shape[1]
        grains = u.reshape(-1, k, u.shape[1])
        relative = grains[self._i] + SIGNS[:k, None] * grains[self._j]
        return (self._stiffness_change @ relative).reshape(-1, u.shape[1])


def _same_pairs(old: Contacts, new: Contacts) -> bool:
    return np.array_equal(old.i, new.i) and np.array_equal(old.j, new.j)


def _changed_contacts(
    old: Contacts,
    old_stiffness: NDArray[np.float64],
    new: Contacts,
    new_stiffness: NDArray[np.float64],
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """(i, j, D) of the contacts that changed, D = K₀ − K (c, k, k)."""
    keys, place = np.unique(np.concatenate([old.key, new.key]), return_inverse=True)
    change = np.zeros((len(keys), *new_stiffness.shape[1:]))
    change[place[: len(old.i)]] += old_stiffness
    change[place[len(old.i) :]] -= new_stiffness
    threshold = CHANGE_THRESHOLD * np.abs(old_stiffness).max(initial=0.0)
    changed = np.flatnonzero(np.abs(change).max(axis=(1, 2)) > threshold)
    i, j = pairs_of_key(keys[changed])
    return i, j, change[changed]
