"""Is the integral of tangential velocities tangential? B, Eq. (10), (A1) and Fig. 10.

    V = ∫ v_T dt = ∫ t ds,    t = (n_y, −n_x) at each instant,    ds = t·dr + dℓ_i + dℓ_j
    Err = |V·n| / |V|                                                                   B (A1)

With φ the angle of the contact and φ_e its angle in the end, V·n = ± ∫ sin(φ_e − φ) ds. Hence

| holds                                        | how well                                    |
| -------------------------------------------- | ------------------------------------------- |
| every increment is tangential, t ds · n = 0  | exactly, whatever the motion                |
| V is tangential, Err = 0                     | to zeroth order in the rotation of contacts |
| V is as long as s                            | to first order                              |

A contact that slides evenly while it turns by α has Err = sin(α/2); one whose s has gone forth and
back has an Err of any size up to 1, as |V| passes 0 while V·n does not. So the second term of
B (10) does not vanish; s, which turns with the contact, needs no such term.

V is summed along the steps of a walk with t halfway between both ends of each, to second order in
the step. Where a law lets springs slip, ds is what they keep.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.packing.contacts import Contacts
from grainmodes.relaxation.balance import Balance


class PathError(NamedTuple):
    """Err and its like over all contacts with V ≠ 0 of one state; NaN where there is none.

    `error_increment` is the largest of the last step alone, against its own n; a turn is the angle
    between n now and n when the contact closed, a length is ||V| − |s|| / |s|.
    """

    strain: float
    error_largest: float
    error_median: float
    error_increment: float
    turn_median: float
    length_median: float


class TangentialPath:
    """V of every contact, carried from state to state."""

    def __init__(self, balance: Balance):
        contacts = balance.contacts
        self._key, self._contacts = _keys(balance), contacts
        self._path = contacts.displacement[:, None] * contacts.tangent
        self._first = contacts.normal

    def follow(self, balance: Balance) -> PathError:
        """Go on to the next state; a contact that has closed begins with V = 0."""
        contacts, key = balance.contacts, _keys(balance)
        new, old = _matched(key, self._key)
        middle, slid = contacts.normal.copy(), contacts.displacement.copy()
        middle[new] += self._contacts.normal[old]
        middle /= np.hypot(*middle.T)[:, None]
        slid[new] -= self._contacts.displacement[old]
        step = slid[:, None] * np.stack([middle[:, 1], -middle[:, 0]], axis=1)
        path, first = step.copy(), contacts.normal.copy()
        path[new] += self._path[old]
        first[new] = self._first[old]
        self._key, self._contacts, self._path, self._first = key, contacts, path, first
        return PathError(
            balance.packing.strain,
            *_spread(error(path, contacts.normal)),
            _spread(error(step, middle))[0],
            _spread(_turn(first, contacts))[1],
            _spread(_length(path, contacts))[1],
        )


def error(path: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """|V·n| / |V| of every contact with V ≠ 0: B (A1)."""
    length = np.hypot(*path.T)
    moved = length > 0.0
    return np.abs(np.sum(path * normal, axis=1))[moved] / length[moved]


def _turn(first: np.ndarray, contacts: Contacts) -> np.ndarray:
    now = contacts.normal
    cross = first[:, 0] * now[:, 1] - first[:, 1] * now[:, 0]
    return np.abs(np.arctan2(cross, np.sum(first * now, axis=1)))


def _length(path: np.ndarray, contacts: Contacts) -> np.ndarray:
    s = np.abs(contacts.displacement)
    return np.abs(np.hypot(*path.T) - s)[s > 0.0] / s[s > 0.0]


def _spread(values: np.ndarray) -> tuple[float, float]:
    """The largest and the median."""
    return (float(values.max()), float(np.median(values))) if len(values) else (np.nan, np.nan)


def _keys(balance: Balance) -> np.ndarray:
    """One number for every contact, ascending."""
    contacts = balance.contacts
    return contacts.i.astype(np.int64) * balance.packing.n + contacts.j


def _matched(key: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places of the contacts that were there before, now and then."""
    _, new, old = np.intersect1d(key, before, assume_unique=True, return_indices=True)
    return new, old
