"""Positions as integer fractions of the box, and checks of the numbers of a packing.

    s = r/L in units of 2⁻⁶⁴, wrapped to [−1/2, 1/2)                       r √(1 + γ²) < L/2

The second formula is the condition under which a touching pair is the image that wrapping finds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from grainmodes.packing.contacts import History


class PackingError(ValueError):
    """A packing with numbers that are not allowed; the message names the grain or the number."""


def to_fraction(value: np.ndarray) -> np.ndarray:
    """Fractions of the box (...,) float64 as int64 in units of 2⁻⁶⁴, wrapped to [−1/2, 1/2)."""
    wrapped = value - np.floor(value)
    # A float64 does not resolve 2⁻⁶⁴, so the upper 32 bits are split off.
    high = np.floor(wrapped * 2.0**32)
    low = np.rint((wrapped * 2.0**32 - high) * 2.0**32)
    return (
        high.astype(np.uint64) * np.uint64(2**32) + low.astype(np.uint64) - np.uint64(2**63)
    ).view(np.int64)


def to_step(value: np.ndarray) -> np.ndarray:
    """Steps (2, N) float64 in units of the box as int64 in units of 2⁻⁶⁴, without whole boxes.

    Raises:
        PackingError: a step is NaN or infinite.
    """
    bad = np.flatnonzero(~np.isfinite(value).all(axis=0))
    if len(bad):
        raise PackingError(
            f"the step of grain {bad[0]}: expected finite numbers, got {value[:, bad[0]]} boxes"
        )
    step = np.rint((value - np.rint(value)) * 2.0**64)
    # Half a box, 2⁶³, exceeds the largest int64 by one, but is also half a box back.
    return np.where(step < 2.0**63, step, -(2.0**63)).astype(np.int64)


def check_grains(position: np.ndarray, diameter: np.ndarray, mass: np.ndarray) -> None:
    """Check positions (N, 2) in d, diameters (N,) in d and masses (N,) in m.

    Raises:
        PackingError: shapes disagree, or a number is not finite, or not positive where it must be.
    """
    n = len(diameter)
    if position.shape != (n, 2) or mass.shape != (n,):
        raise PackingError(
            f"expected positions ({n}, 2) and masses ({n},) for {n} diameters, "
            f"got {position.shape} and {mass.shape}"
        )
    if n < 2:
        raise PackingError(f"a packing: expected at least 2 grains, got {n}")
    for name, array in (("position", position), ("diameter", diameter), ("mass", mass)):
        bad = ~np.isfinite(array) if name == "position" else ~(np.isfinite(array) & (array > 0))
        if bad.any():
            grain = int(np.argwhere(bad)[0][0])
            kind = "finite" if name == "position" else "finite positive"
            raise PackingError(
                f"{name} of grain {grain}: expected {kind} numbers, got {array[grain]}"
            )


def check_rotation(rotation: np.ndarray | None) -> None:
    """Check rotations (N,) in d, if there are any.

    Raises:
        PackingError: a rotation is NaN or infinite.
    """
    if rotation is None:
        return
    bad = np.flatnonzero(~np.isfinite(rotation))
    if len(bad):
        raise PackingError(
            f"rotation of grain {bad[0]}: expected a finite number, got {rotation[bad[0]]}"
        )


def check_springs(history: History | None) -> None:
    """Check the spring states of a history, if there is one.

    Raises:
        PackingError: a spring state is NaN or infinite.
    """
    if history is None:
        return
    bad = np.flatnonzero(~np.isfinite(history.spring_state))
    if len(bad):
        i, j, s = (getattr(history, x)[bad[0]] for x in ("i", "j", "spring_state"))
        raise PackingError(
            f"the spring between grains {i} and {j}: expected a finite number, got {s}"
        )


def check_box(diameter: np.ndarray, box_length: float, strain: float) -> None:
    """Check that the box of length L, sheared by γ, is large enough for its grains (N,).

    Raises:
        PackingError: L or γ is not finite, or r √(1 + γ²) < L/2 fails for a touching pair.
    """
    for name, value in (("box_length", box_length), ("strain", strain)):
        if not np.isfinite(value):
            raise PackingError(f"{name}: expected a finite number, got {value}")
    least = 2.0 * diameter.max() * np.sqrt(1.0 + strain**2)
    if not box_length > least:
        raise PackingError(
            f"box_length: expected more than {least:.6g} at strain {strain} (two diameters times "
            "sqrt(1 + strain^2); otherwise a grain meets two images of another), "
            f"got {box_length}"
        )
