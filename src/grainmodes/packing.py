"""The state of a packing: where the grains are, what touches what, and which grains are rattlers.

| symbol            | name                    | shape, type          | unit    |
| ----------------- | ----------------------- | -------------------- | ------- |
| s_i = r_i / L     | fraction                | (2, N) int64         | 2⁻⁶⁴ L  |
| d_i               | diameter                | (N,) float64         | d       |
| m_i               | mass                    | (N,) float64         | m       |
| ℓ_i = d_i θ_i / 2 | rotation                | (N,) float64 or None | d       |
| L, γ              | box_length, strain      | float                | d, 1    |
| n_ij = r_ij/r_ij  | normal                  | (C, 2) float64       | 1       |
| r_ij, ξ_ij        | distance, overlap       | (C,) float64         | d       |
| s_ij, ξ_T,ij      | tangential_displacement | (C,) float64 or None | d       |

A packing is never changed in place. Compression changes L, affine shear changes γ, and neither
touches the fractions. Friction that was never loaded is `None`: it is neither stored nor computed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from grainmodes.kernels.neighbours import RESOLUTION, find_neighbours


class PackingError(ValueError):
    """A packing that cannot be what it says; the message names the grain or the number."""


@dataclass(frozen=True)
class Contacts:
    """Touching pairs, i > j, sorted by (i, j); n points from j to i."""

    i: np.ndarray
    j: np.ndarray
    normal: np.ndarray
    distance: np.ndarray
    overlap: np.ndarray
    tangential_displacement: np.ndarray | None = None

    @property
    def tangent(self) -> np.ndarray:
        """t = (n_y, −n_x), shape (C, 2)."""
        return np.stack([self.normal[:, 1], -self.normal[:, 0]], axis=1)

    @property
    def displacement(self) -> np.ndarray:
        """s of every contact, zero where friction was never loaded; shape (C,)."""
        s = self.tangential_displacement
        return np.zeros(len(self.i)) if s is None else s


@dataclass(frozen=True)
class History:
    """Contacts with their tangential displacement s: pairs i > j sorted by (i, j)."""

    i: np.ndarray
    j: np.ndarray
    tangential_displacement: np.ndarray

    def among(self, keep: np.ndarray) -> History:
        """The contacts between the grains of a (N,) mask, in their new numbers."""
        held = keep[self.i] & keep[self.j]
        number = np.cumsum(keep, dtype=np.int32) - 1
        return History(
            number[self.i[held]], number[self.j[held]], self.tangential_displacement[held]
        )


@dataclass(frozen=True)
class Packing:
    """Grains in a periodic (sheared) square box."""

    fraction: np.ndarray
    diameter: np.ndarray
    mass: np.ndarray
    box_length: float
    strain: float = 0.0
    rotation: np.ndarray | None = None
    history: History | None = None

    @classmethod
    def from_positions(cls, position, diameter, box_length, strain=0.0, mass=None, history=None):
        """A packing from absolute positions (N, 2) in d; mass defaults to d_i² (A, B).

        Raises:
            PackingError: shapes disagree, a number is not finite, a diameter or L not positive.
        """
        position = np.asarray(position, float)
        diameter = np.array(diameter, float)
        mass = diameter**2 if mass is None else np.array(mass, float)
        _check(position, diameter, mass)
        _check_box(diameter, box_length, strain)
        y = position[:, 1] / box_length
        x = position[:, 0] / box_length - strain * y
        return cls(
            np.stack([_to_fraction(x), _to_fraction(y)]),
            diameter,
            mass,
            float(box_length),
            float(strain),
            None,
            history,
        )

    @property
    def n(self) -> int:
        """Number of grains."""
        return self.diameter.shape[0]

    @property
    def phi(self) -> float:
        """Projected area fraction Σ π d_i²/4 / L²."""
        return float(np.sum(np.pi * self.diameter**2 / 4.0) / self.box_length**2)

    @property
    def position(self) -> np.ndarray:
        """Positions (N, 2) in [0, L) of the sheared frame, in d (rounded: `fraction` is exact)."""
        x, y = self.fraction * RESOLUTION + 0.5
        sheared = (x + self.strain * (y - 0.5)) % 1.0
        return np.stack([sheared, y], axis=1) * self.box_length

    def at(self, phi: float) -> Packing:
        """The same fractions in the box of area fraction φ: affine compression, A (A1), (A2)."""
        area = np.sum(np.pi * self.diameter**2 / 4.0)
        return replace(self, box_length=float(np.sqrt(area / phi)))

    def sheared(self, strain: float) -> Packing:
        """The same fractions in the box at strain γ: affine shear.

        Raises:
            PackingError: the box is too small to be sheared so far.
        """
        _check_box(self.diameter, self.box_length, strain)
        return replace(self, strain=float(strain))

    def displaced(self, displacement: np.ndarray) -> Packing:
        """Grains moved by (N, 2) in d; the rotation is left alone."""
        s_y = displacement[:, 1] / self.box_length
        s_x = displacement[:, 0] / self.box_length - self.strain * s_y
        step = np.rint(np.stack([s_x, s_y]) / RESOLUTION).astype(np.int64)
        return replace(self, fraction=self.fraction + step)

    def without(self, mask: np.ndarray) -> Packing:
        """The packing without the grains of a (N,) mask, renumbered, its springs with it."""
        keep = ~mask
        return replace(
            self,
            fraction=np.ascontiguousarray(self.fraction[:, keep]),
            diameter=self.diameter[keep],
            mass=self.mass[keep],
            rotation=None if self.rotation is None else self.rotation[keep],
            history=None if self.history is None else self.history.among(keep),
        )


def find_contacts(packing: Packing) -> Contacts:
    """All touching pairs, r < (d_i + d_j)/2, with s from the history where there is one.

    Raises:
        PackingError: two grains lie at the same place.
    """
    if packing.n == 0:
        nothing = np.zeros(0, np.int32)
        return Contacts(nothing, nothing, np.zeros((0, 2)), np.zeros(0), np.zeros(0))
    x, y = packing.fraction
    pairs = find_neighbours(x, y, packing.diameter, packing.box_length, packing.strain, 0.0)
    i, j = pairs.right.astype(np.int32), pairs.left.astype(np.int32)
    order = np.lexsort((j, i))
    i, j, reach = i[order], j[order], pairs.reach[order]
    delta = (packing.fraction[:, i] - packing.fraction[:, j]) * (packing.box_length * RESOLUTION)
    delta[0] += packing.strain * delta[1]
    distance = np.sqrt(delta[0] ** 2 + delta[1] ** 2)
    if np.any(distance == 0.0):
        k = int(np.argmin(distance))
        raise PackingError(f"grains {i[k]} and {j[k]} lie at the same place: no normal is defined")
    normal = (delta / distance).T
    s = None if packing.history is None else _matched(packing.history, i, j, packing.n)
    return Contacts(i, j, normal, distance, reach - distance, s)


def _matched(history: History, i: np.ndarray, j: np.ndarray, n: int) -> np.ndarray:
    """s of the contacts (i, j): that of the history, and 0 at first touch."""
    keys = history.i.astype(np.int64) * n + history.j
    wanted = i.astype(np.int64) * n + j
    s = np.zeros(len(i))
    if len(keys):
        place = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
        known = keys[place] == wanted
        s[known] = history.tangential_displacement[place[known]]
    return s


def rattlers(contacts: Contacts, n: int, threshold: int) -> np.ndarray:
    """(N,) bool: grains of at most `threshold` contacts, removed until none is left: A, App. E."""
    gone = np.zeros(n, bool)
    while True:
        held = ~(gone[contacts.i] | gone[contacts.j])
        degree = np.bincount(contacts.i[held], minlength=n)
        degree += np.bincount(contacts.j[held], minlength=n)
        newly = (degree <= threshold) & ~gone
        if not newly.any():
            return gone
        gone |= newly


def _to_fraction(value: np.ndarray) -> np.ndarray:
    """Real fractions of the box as integers in units of 2⁻⁶⁴, wrapped to [−1/2, 1/2)."""
    wrapped = value - np.floor(value)
    # 2⁻⁶⁴ resolution needs more than a float64 holds: split off the upper 32 bits.
    high = np.floor(wrapped * 2.0**32)
    low = np.rint((wrapped * 2.0**32 - high) * 2.0**32)
    return (
        high.astype(np.uint64) * np.uint64(2**32) + low.astype(np.uint64) - np.uint64(2**63)
    ).view(np.int64)


def _check(position, diameter, mass) -> None:
    n = len(diameter)
    if position.shape != (n, 2) or mass.shape != (n,):
        raise PackingError(
            f"positions {position.shape} and masses {mass.shape} do not fit {n} diameters"
        )
    if n < 2:
        raise PackingError(f"a packing needs at least 2 grains, got {n}")
    for name, array in (("position", position), ("diameter", diameter), ("mass", mass)):
        bad = ~np.isfinite(array) if name == "position" else ~(np.isfinite(array) & (array > 0))
        if bad.any():
            grain = int(np.argwhere(bad)[0][0])
            raise PackingError(f"{name} of grain {grain} is {array[grain]}: not a valid number")


def _check_box(diameter: np.ndarray, box_length: float, strain: float) -> None:
    """A touching pair must be the image that wrapping s to [−1/2, 1/2) finds: r √(1 + γ²) < L/2."""
    least = 2.0 * diameter.max() * np.sqrt(1.0 + strain**2)
    if not (np.isfinite(box_length) and box_length > least):
        raise PackingError(
            f"box_length = {box_length} at strain {strain}: must exceed {least:.6g}, two diameters "
            "times sqrt(1 + strain^2), or a grain meets two images of another"
        )
