"""The factors of an earlier J, fitted to a state whose contacts have changed since.

Most contacts hardly change from one balance to the next; a few open, close or begin to slide. With
J = −Σ P K Pᵀ over the contacts, P (kN, k) the grains i, j that a contact hangs on,

    J = J₀ + P D Pᵀ + small,      D = K₀ − K of the contacts that changed      (K = 0 where open)
    J⁻¹ f ≈ u₀ − W C⁻¹ D Pᵀ u₀,   u₀ = J₀⁻¹ f,   W = J₀⁻¹ P,   C = 1 + D Pᵀ W        (Woodbury)

det J = det J₀ det C: as contacts change, an eigenvalue of J passes zero together with one of C.

| symbol | name      | shape                              |
| ------ | --------- | ---------------------------------- |
| K      | stiffness | (C, k, k)                          |
| W      | answer    | (kN, kc) of c contacts             |
| D Pᵀ W | –         | (kc, kc)                           |
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from grainmodes.linalg.pinned_factor import PinnedFactor
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import SIGNS

CHANGED = 0.03
"""Change of the stiffness of a contact, in the largest of all, that is more than small."""

MOST_CHANGED = 12
"""Contacts beyond which new factors are cheaper: each of them costs k solutions."""


class Origin:
    """An earlier J: its factors, its contacts and, as they are needed, their answers W."""

    def __init__(self, factor: PinnedFactor, contacts: Contacts, stiffness: np.ndarray):
        self.factor = factor
        self._contacts, self._stiffness = contacts, stiffness
        self._answers: dict[tuple[int, int], np.ndarray] = {}
        self._latest = contacts, Fitted(factor, contacts.i[:0], contacts.j[:0], stiffness[:0], [])

    def fitted(self, contacts: Contacts, stiffness: Callable[[], np.ndarray]) -> Fitted | None:
        """The factors for these contacts between the same grains; None if too many changed.

        They stay as they are until a contact opens or closes.
        """
        if not _same(contacts, self._latest[0]):
            self._latest = contacts, self._fitted(contacts, stiffness())
        return self._latest[1]

    def _fitted(self, contacts: Contacts, stiffness: np.ndarray) -> Fitted | None:
        i, j, softened = _changes(self._contacts, self._stiffness, contacts, stiffness)
        if len(i) > MOST_CHANGED:
            return None
        answer = [self._answer(*pair, stiffness.shape[1]) for pair in zip(i, j, strict=True)]
        return Fitted(self.factor, i, j, softened, answer)

    def _answer(self, i: int, j: int, k: int) -> np.ndarray:
        """J₀⁻¹ P of one contact, (kN, k)."""
        if (i, j) not in self._answers:
            pulls = np.zeros((k, self.factor.size))
            for a in range(k):
                pulls[a, k * i + a], pulls[a, k * j + a] = 1.0, SIGNS[a]
            columns = [self.factor.solve(pull, refined=False) for pull in pulls]
            self._answers[i, j] = np.stack(columns, axis=1)
        return self._answers[i, j]


class Fitted:
    """(J₀ + P D Pᵀ)⁻¹ for the contacts (i, j) whose stiffness fell by D, (c, k, k).

    Attributes:
        turned: J₀ and J may have different numbers of negative eigenvalues.
    """

    def __init__(self, factor: PinnedFactor, i, j, softened: np.ndarray, answer: list[np.ndarray]):
        self._factor, self._i, self._j, self._softened = factor, i, j, softened
        self.turned = False
        if answer:
            answers = np.concatenate(answer, axis=1)
            coupling = np.eye(answers.shape[1]) + self._loads(answers)
            values = np.linalg.eigvals(coupling)
            self.turned = bool(np.any((values.real <= 0.0) & (values.imag == 0.0)))
            self._correction = np.linalg.solve(coupling.T, answers.T).T

    def solve(self, force: np.ndarray) -> np.ndarray:
        """u with (J₀ + P D Pᵀ) u = `force`, (kN,), not refined."""
        u = self._factor.solve(force, refined=False)
        if len(self._i):
            u -= self._correction @ self._loads(u[:, None])[:, 0]
        return u

    def _loads(self, u: np.ndarray) -> np.ndarray:
        """D Pᵀ u of every contact, (kc, columns), from fields (kN, columns)."""
        k = self._softened.shape[1]
        grains = u.reshape(-1, k, u.shape[1])
        strain = grains[self._i] + SIGNS[:k, None] * grains[self._j]
        return (self._softened @ strain).reshape(-1, u.shape[1])


def _same(old: Contacts, new: Contacts) -> bool:
    return np.array_equal(old.i, new.i) and np.array_equal(old.j, new.j)


def _changes(old: Contacts, old_stiffness, new: Contacts, new_stiffness):
    """(i, j, D) of the contacts that changed, D = K₀ − K (c, k, k)."""
    pairs, place = np.unique(np.concatenate([_numbers(old), _numbers(new)]), return_inverse=True)
    softened = np.zeros((len(pairs), *new_stiffness.shape[1:]))
    softened[place[: len(old.i)]] += old_stiffness
    softened[place[len(old.i) :]] -= new_stiffness
    allowed = CHANGED * np.abs(old_stiffness).max(initial=0.0)
    changed = np.flatnonzero(np.abs(softened).max(axis=(1, 2)) > allowed)
    i, j = np.divmod(pairs[changed], 2**32)
    return i, j, softened[changed]


def _numbers(contacts: Contacts) -> np.ndarray:
    """One number for every contact."""
    return contacts.i.astype(np.int64) * 2**32 + contacts.j
