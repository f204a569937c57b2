"""What happens between two states of a shear: changes of the contact network and plastic events.

| an event is      | when                                                           |
| ---------------- | -------------------------------------------------------------- |
| a stress drop    | σ falls, by more than a negative g explains B, Sec. IV (i)     |
| a rigidity drop  | g falls by more than 1e-2 k_N               B, Sec. IV (ii)    |

    Δq̊|_c = q(γ_c+) − q(γ_c−) − Δγ (y, 0, 0)                                        B (52), (53)

σ = (σ_xy + σ_yx)/2 and g = dσ/dγ are those of the loading protocol in use. They contain the term
f_y y_ij that B (43) drops.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_by_slide
from grainmodes.packing.state import Packing, nonaffine_motion
from grainmodes.protocols.shear.sheared_state import CurvePoint, ShearedState
from grainmodes.relaxation.equilibrium_state import EquilibriumState

MIN_RIGIDITY_DROP = 1e-2
"""Fall of g, in k_N, above which a step is plastic: B, Sec. IV (ii)."""

STRESS_DROP, RIGIDITY_DROP = 1, 2
"""The kind of an event is one of these, or their sum."""

PATH_CURVATURE = 10.0
"""Upper bound of what a curved path may add to s, in units of the motion squared over d."""


class NetworkChange(NamedTuple):
    """Numbers of contacts opened and closed between two strains; a jump may change none."""

    strain_before: float
    strain_after: float
    opened: int
    closed: int
    jumped: bool


class PlasticEvent(NamedTuple):
    """A plastic event between two saved states; `displacement` is Δq̊|_c, (N, k) in d."""

    kind: int
    before: Packing
    after: Packing
    points: tuple[CurvePoint, CurvePoint]
    opened: int
    closed: int
    displacement: np.ndarray

    @classmethod
    def from_states(
        cls, before: ShearedState, after: ShearedState, kind: int, opened: int, closed: int
    ) -> PlasticEvent:
        """The event that lies between two states, without the motion of the centre."""
        first, last = (state.equilibrium.packing.without_contacts() for state in (before, after))
        points = before.curve_point(with_lowest=True), after.curve_point(with_lowest=True)
        displacement = nonaffine_motion(first, last)
        displacement[:, :2] -= displacement[:, :2].mean(axis=0)
        return cls(kind, first, last, points, opened, closed, displacement)


def event_kind(before: ShearedState, after: ShearedState) -> int:
    """The kind of the event between two states: 0 without one, or the sum of B's two criteria."""
    explained = min(0.0, before.g, after.g) * (after.strain - before.strain)
    stress_fell = after.sigma - before.sigma < 2.0 * explained
    rigidity_fell = before.g - after.g > MIN_RIGIDITY_DROP
    return STRESS_DROP * stress_fell + RIGIDITY_DROP * rigidity_fell


def count_network_changes(before: EquilibriumState, after: EquilibriumState) -> tuple[int, int]:
    """Numbers of contacts between grains that carry load which have opened and have closed."""
    old, new = before.contact_keys, after.contact_keys
    if np.array_equal(old, new):
        return 0, 0
    common = len(np.intersect1d(old, new, assume_unique=True))
    return len(old) - common, len(new) - common


def count_reopened(before: Packing, after: Packing, interaction: Interaction) -> int:
    """Number of contacts of both states that opened between them and closed again.

    The spring of such a contact starts anew from s = 0. Of the old spring the motion would make
    s + w Δs, with Δs = t·Δr + Δℓ, t in the middle, and w = 1, or w = k_T w(ξ) where the spring
    remembers a force. That is known to the square of the motion; a contact counts if its s differs
    from it by more.
    """
    if before.history is None or after.history is None:
        return 0
    motion = nonaffine_motion(before, after)
    contacts, old = after.contacts, before.history
    place = _place_in_history(old.key, contacts.key)
    common = place >= 0
    i, j, s = contacts.i[common], contacts.j[common], contacts.springs[common]
    relative = motion[i] - motion[j]
    along = np.einsum("ca,ca->c", relative[:, :2], contacts.tangent[common])
    zero, one = np.zeros(len(s)), np.ones(len(s))
    weight = advance_by_slide(interaction, contacts.overlap[common], zero, one)
    s_before = old.spring_state[place[common]]
    difference = np.abs(s - s_before - weight * (along + motion[i, 2] + motion[j, 2]))
    square = weight * (np.abs(motion[i]) + np.abs(motion[j])).sum(axis=1) ** 2
    restarted = (difference > 0.5 * np.abs(s_before)) & (difference > PATH_CURVATURE * square)
    return int(np.count_nonzero(restarted))


def _place_in_history(old: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Place of each wanted pair among the old ones, by their keys, (C,) int; -1 if absent."""
    place = np.minimum(np.searchsorted(old, wanted), len(old) - 1)
    return np.where(old[place] == wanted, place, -1) if len(old) else place
