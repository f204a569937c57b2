"""The state of a packing: its grains and their places, from which the contacts follow.

| symbol            | name                    | shape, type          | unit    |
| ----------------- | ----------------------- | -------------------- | ------- |
| s_i = r_i / L     | fraction                | (2, N) int64         | 2⁻⁶⁴ L  |
| d_i               | diameter                | (N,) float64         | d       |
| m_i               | mass                    | (N,) float64         | m       |
| ℓ_i = d_i θ_i / 2 | rotation                | (N,) float64 or None | d       |
| L, γ              | box_length, strain      | float                | d, 1    |

A packing is never changed in place. Compression changes L, affine shear changes γ, and neither
changes the fractions. The contacts are computed at their first use and then kept, 48 bytes each.
Lists of many packings should therefore hold them `without_contacts`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from grainmodes.kernels.lanes import lane_sum
from grainmodes.kernels.neighbours import (
    FRACTION_UNIT,
    find_neighbours,
    touching_pairs,
    values_of_pairs,
)
from grainmodes.packing.box import (
    PackingError,
    check_box,
    check_grains,
    check_rotation,
    check_springs,
    to_fraction,
    to_step,
)
from grainmodes.packing.contacts import Contacts, History


@dataclass(frozen=True)
class Packing:
    """Grains in a periodic (sheared) square box; shapes, types and units are in the table above."""

    fraction: np.ndarray
    diameter: np.ndarray
    mass: np.ndarray
    box_length: float
    strain: float = 0.0
    rotation: np.ndarray | None = None
    history: History | None = None

    @classmethod
    def from_positions(
        cls,
        position: ArrayLike,
        diameter: ArrayLike,
        box_length: float,
        strain: float = 0.0,
        mass: ArrayLike | None = None,
        history: History | None = None,
    ) -> Packing:
        """A packing from absolute positions (N, 2) in d, in the frame of the sheared box.

        Args:
            diameter: (N,) in d.
            mass: (N,) in m; d_i² by default (A, B).
            history: springs in any order of the pairs.

        Raises:
            PackingError: shapes disagree, a number is not finite, a diameter or L not positive.
        """
        places, diameters = np.asarray(position, float), np.array(diameter, float)
        masses = diameters**2 if mass is None else np.array(mass, float)
        check_grains(places, diameters, masses)
        check_box(diameters, box_length, strain)
        check_springs(history)
        y = places[:, 1] / box_length
        x = places[:, 0] / box_length - strain * y
        return cls(
            np.stack([to_fraction(x), to_fraction(y)]),
            diameters,
            masses,
            float(box_length),
            float(strain),
            None,
            None
            if history is None
            else History.from_pairs(history.i, history.j, history.spring_state),
        )

    def checked(self) -> Packing:
        """This packing, after its numbers have been checked.

        Raises:
            PackingError: a number is not finite, a diameter or mass not positive, L too small.
        """
        check_grains(self.fraction.T, self.diameter, self.mass)
        check_box(self.diameter, self.box_length, self.strain)
        check_rotation(self.rotation)
        check_springs(self.history)
        return self

    @cached_property
    def contacts(self) -> Contacts:
        """The touching pairs, computed once; not part of a copy, a pickle or a comparison.

        Raises:
            PackingError: two grains lie at the same place.
        """
        return find_contacts(self)

    def __getstate__(self) -> dict[str, object]:
        return {name: value for name, value in self.__dict__.items() if name != "contacts"}

    def without_contacts(self) -> Packing:
        """The same packing, its contacts not computed yet: for states kept in large numbers."""
        return replace(self)

    @property
    def n(self) -> int:
        """Number of grains."""
        return self.diameter.shape[0]

    @property
    def area(self) -> float:
        """Area of all grains, Σ π d_i²/4 in d², summed in an order that no machine changes."""
        return lane_sum(np.pi * self.diameter**2 / 4.0)

    @property
    def phi(self) -> float:
        """Projected area fraction Σ π d_i²/4 / L²."""
        return self.area / self.box_length**2

    @property
    def position(self) -> np.ndarray:
        """Positions (N, 2) in [0, L) of the sheared frame, in d (rounded: `fraction` is exact)."""
        x, y = self.fraction * FRACTION_UNIT + 0.5
        sheared = (x + self.strain * y) % 1.0
        return np.stack([sheared, y], axis=1) * self.box_length

    def at(self, phi: float) -> Packing:
        """The same fractions in the box of area fraction φ: affine compression, A (A1), (A2).

        Raises:
            PackingError: φ is not positive, or its box too small.
        """
        if not phi > 0.0:
            raise PackingError(f"phi: expected a positive area fraction, got {phi}")
        box_length = math.sqrt(self.area / phi)
        check_box(self.diameter, box_length, self.strain)
        return replace(self, box_length=box_length)

    def sheared(self, strain: float) -> Packing:
        """The same fractions in the box at strain γ: affine shear.

        Raises:
            PackingError: the box is too small to be sheared so far.
        """
        check_box(self.diameter, self.box_length, strain)
        return replace(self, strain=float(strain))

    def displaced(self, displacement: np.ndarray) -> Packing:
        """The packing with its grains moved by (N, 2) in d, any number of boxes far; ℓ stays.

        Raises:
            PackingError: a displacement is NaN or infinite.
        """
        s_y = displacement[:, 1] / self.box_length
        s_x = displacement[:, 0] / self.box_length - self.strain * s_y
        return replace(self, fraction=self.fraction + to_step(np.stack([s_x, s_y])))

    def with_springs(self, spring_state: np.ndarray) -> Packing:
        """The same grains with these spring states (C,) in the contacts, in d or k_N d^(3/2)."""
        contacts = self.contacts
        loaded = replace(self, history=History(contacts.i, contacts.j, spring_state))
        return loaded._with_contacts(replace(contacts, spring_state=spring_state))

    def without(self, mask: np.ndarray) -> Packing:
        """The packing without the grains of a mask (N,) bool: renumbered, with its springs."""
        keep = ~mask
        smaller = replace(
            self,
            fraction=np.ascontiguousarray(self.fraction[:, keep]),
            diameter=self.diameter[keep],
            mass=self.mass[keep],
            rotation=None if self.rotation is None else self.rotation[keep],
            history=None if self.history is None else self.history.among(keep),
        )
        known = "contacts" in self.__dict__ and keep.any()
        return smaller._with_contacts(self.contacts.among(keep)) if known else smaller

    def _with_contacts(self, contacts: Contacts) -> Packing:
        """This packing, its contacts given instead of computed."""
        self.__dict__["contacts"] = contacts
        return self


def nonaffine_motion(before: Packing, after: Packing) -> np.ndarray:
    """(Δr̊, Δℓ̊) of every grain between two states of a packing, (N, k) in d: A (10), (11).

    r = L (s_x + γ s_y, s_y), of which the change of γ alone is the affine part. The difference of
    the fractions is exact. Without rotation k is 2.
    """
    x, y = (after.fraction - before.fraction) * (FRACTION_UNIT * before.box_length)
    moved = [x + after.strain * y, y]
    if after.rotation is not None:
        at_first = 0.0 if before.rotation is None else before.rotation
        moved.append(after.rotation - at_first)
    return np.stack(moved, axis=1)


def find_contacts(packing: Packing) -> Contacts:
    """All touching pairs, r < (d_i + d_j)/2, with their spring states if there is a history.

    Use `Packing.contacts`, which calls this once.

    Raises:
        PackingError: two grains lie at the same place.
    """
    if packing.n == 0:
        nothing = np.zeros(0, np.int32)
        return Contacts(nothing, nothing, np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    x, y = packing.fraction
    pairs = find_neighbours(x, y, packing.diameter, packing.box_length, packing.strain, 0.0)
    scale = packing.box_length * FRACTION_UNIT
    i, j, normal, distance, overlap = touching_pairs(x, y, pairs, scale, packing.strain)
    if len(i) and distance.min() == 0.0:
        k = int(np.argmin(distance))
        raise PackingError(f"grains {i[k]} and {j[k]} lie at the same place: no normal is defined")
    known = packing.history
    if known is None:
        return Contacts(i, j, normal, distance, overlap)
    s = values_of_pairs(known.i, known.j, known.spring_state, i, j)
    return Contacts(i, j, normal, distance, overlap, s)


def rattlers(packing: Packing, threshold: int) -> np.ndarray:
    """(N,) bool: grains of at most `threshold` contacts, removed until none is left: A, App. E."""
    contacts, n = packing.contacts, packing.n
    is_rattler = np.zeros(n, bool)
    while True:
        between = ~(is_rattler[contacts.i] | is_rattler[contacts.j])
        degree = np.bincount(contacts.i[between], minlength=n)
        degree += np.bincount(contacts.j[between], minlength=n)
        further = (degree <= threshold) & ~is_rattler
        if not further.any():
            return is_rattler
        is_rattler |= further


def backbone(packing: Packing, threshold: int) -> Packing:
    """The packing without its rattlers, those of at most `threshold` contacts."""
    is_rattler = rattlers(packing, threshold)
    return packing.without(is_rattler) if is_rattler.any() else packing


def nan_on_rattlers(field: np.ndarray, backbone_mask: np.ndarray) -> np.ndarray:
    """A field (N', k) of the backbone on all N grains, (N, 3) float64; NaN where it has no value.

    Args:
        backbone_mask: (N,) bool, the N' grains of the backbone.
    """
    whole = np.full((len(backbone_mask), 3), np.nan)
    whole[backbone_mask, : field.shape[1]] = field
    return whole


def zero_on_rattlers(values: np.ndarray, backbone_mask: np.ndarray) -> np.ndarray:
    """Values (N', …) of the backbone on all N grains, (N, …) of the same dtype; 0 on rattlers."""
    whole = np.zeros((len(backbone_mask), *values.shape[1:]), values.dtype)
    whole[backbone_mask] = values
    return whole
