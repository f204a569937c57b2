"""What is measured on a sheared state, and what is recorded of the way: B (15)-(18), (42)-(53).

    σ_αβ(γ),   g_αβ = dσ_αβ/dγ by one solve with J,   the energy E that the contacts store
    Δq̊|_c = q(γ_c+) − q(γ_c−) − Δγ (y, 0, 0)                                        B (52), (53)

The rigidity is that of the loading protocol in use (`rigidity`), unloaded in B.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_by_slide
from grainmodes.packing.forces import energy, stress
from grainmodes.packing.state import Packing, find_contacts, nonaffine_motion
from grainmodes.relaxation.balance import Balance
from grainmodes.response.moduli import AffineStep, Moduli
from grainmodes.response.stability import lowest_eigenvalue

CURVED = 10.0
"""What the path of a motion may add to s, in units of its square over d."""


class Point(NamedTuple):
    """One state of a curve, in numbers; `lowest` is NaN where it was not asked for."""

    strain: float
    stress: np.ndarray
    modulus: np.ndarray
    energy: float
    contact_number: float
    lowest: float


class Change(NamedTuple):
    """Contacts opened and closed between two strains; a jump may change none."""

    strain_before: float
    strain_after: float
    opened: int
    closed: int
    jumped: bool


@dataclass(frozen=True)
class State:
    """A balance at a strain of `units` Δγ_Th; `jumped`: the dynamics had to find it.

    `drift` is the non-affine field dq̊/dγ of a state near it, from which its own is iterated.
    """

    balance: Balance
    units: int
    loaded: bool
    jumped: bool = False
    drift: np.ndarray | None = None

    @property
    def strain(self) -> float:
        """γ."""
        return self.balance.packing.strain

    @cached_property
    def stress(self) -> np.ndarray:
        """σ_αβ, (2, 2)."""
        balance = self.balance
        return stress(balance.backbone, balance.backbone_contacts, balance.interaction)

    @cached_property
    def response(self) -> Moduli:
        """The answer to a small step from here; dq̊/dγ on the grains that carry load: B (41)."""
        balance = self.balance
        step = AffineStep(
            balance.backbone, balance.backbone_contacts, balance.interaction, self.loaded
        )
        return step.moduli(balance.solved(step.force, self.drift))

    @cached_property
    def modulus(self) -> np.ndarray:
        """dσ_αβ/dγ of a small step from here, (2, 2)."""
        return self.response.affine + self.response.nonaffine

    @property
    def sigma(self) -> float:
        """σ = (σ_xy + σ_yx)/2."""
        return float(self.stress[0, 1] + self.stress[1, 0]) / 2.0

    @property
    def g(self) -> float:
        """g = (g_xy + g_yx)/2."""
        return float(self.modulus[0, 1] + self.modulus[1, 0]) / 2.0

    @cached_property
    def lowest(self) -> float:
        """Smallest |λ| of J but its two translations, with the sign of its real part."""
        balance = self.balance
        return lowest_eigenvalue(balance.matrix, balance.factor, balance.force.shape[1])

    def point(self, with_lowest: bool) -> Point:
        """This state of a curve."""
        balance = self.balance
        grains = int(balance.held.sum())
        return Point(
            self.strain,
            self.stress,
            self.modulus,
            energy(balance.backbone_contacts, balance.interaction),
            2.0 * len(balance.backbone_contacts.i) / grains if grains else 0.0,
            self.lowest if with_lowest else np.nan,
        )


class Event(NamedTuple):
    """A plastic event between two saved states; `displacement` is Δq̊|_c, (N, k) in d."""

    kind: int
    before: Packing
    after: Packing
    points: tuple[Point, Point]
    opened: int
    closed: int
    displacement: np.ndarray

    @classmethod
    def between(cls, before: State, after: State, kind: int, opened: int, closed: int) -> Event:
        """The event that lies between two states."""
        packings = before.balance.packing, after.balance.packing
        points = before.point(with_lowest=True), after.point(with_lowest=True)
        moved = nonaffine_motion(*packings)
        moved[:, :2] -= moved[:, :2].mean(axis=0)
        return cls(kind, *packings, points, opened, closed, moved)


def network_changes(before: Balance, after: Balance) -> tuple[int, int]:
    """Contacts between grains that carry load which have opened, and which have closed."""
    old, new = before.network, after.network
    if np.array_equal(old, new):
        return 0, 0
    same = len(np.intersect1d(old, new, assume_unique=True))
    return len(old) - same, len(new) - same


def reopened(before: Packing, after: Packing, interaction: Interaction) -> int:
    """Contacts of both states that let go of their spring between them: they opened, and closed.

    Such a spring starts anew from s = 0 and misses what the motion makes of the old one,
    s + w Δs, Δs = t·Δr + Δℓ with t at the middle and w = 1, or k_T w(ξ) where it remembers a force.
    That is known to the square of the motion.
    """
    if before.history is None or after.history is None:
        return 0
    moved = nonaffine_motion(before, after)
    contacts, old = find_contacts(after), before.history
    s, known = contacts.displacement, _place(old.i, old.j, contacts.i, contacts.j, before.n)
    both = known >= 0
    i, j, s, known = contacts.i[both], contacts.j[both], s[both], known[both]
    slip = moved[i] - moved[j]
    along = np.einsum("ca,ca->c", slip[:, :2], contacts.tangent[both])
    nothing, one = np.zeros(len(s)), np.ones(len(s))
    weight = advance_by_slide(interaction, contacts.overlap[both], nothing, one)
    had = old.spring_state[known]
    missing = np.abs(s - had - weight * (along + moved[i, 2] + moved[j, 2]))
    square = weight * (np.abs(moved[i]) + np.abs(moved[j])).sum(axis=1) ** 2
    return int(np.count_nonzero((missing > 0.5 * np.abs(had)) & (missing > CURVED * square)))


def _place(i: np.ndarray, j: np.ndarray, of_i: np.ndarray, of_j: np.ndarray, n: int) -> np.ndarray:
    """Where each pair (of_i, of_j) stands among the sorted pairs (i, j); -1: nowhere."""
    pairs, wanted = i.astype(np.int64) * n + j, of_i.astype(np.int64) * n + of_j
    place = np.minimum(np.searchsorted(pairs, wanted), len(pairs) - 1)
    return np.where(pairs[place] == wanted, place, -1) if len(pairs) else place
