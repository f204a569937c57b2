"""What fits into the box: fractions of it as integers, and numbers that can be grains."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from grainmodes.packing.contacts import History


class PackingError(ValueError):
    """A packing that cannot be what it says; the message names the grain or the number."""


def to_fraction(value: np.ndarray) -> np.ndarray:
    """Real fractions of the box as integers in units of 2⁻⁶⁴, wrapped to [−1/2, 1/2)."""
    wrapped = value - np.floor(value)
    # 2⁻⁶⁴ resolution needs more than a float64 holds: split off the upper 32 bits.
    high = np.floor(wrapped * 2.0**32)
    low = np.rint((wrapped * 2.0**32 - high) * 2.0**32)
    return (
        high.astype(np.uint64) * np.uint64(2**32) + low.astype(np.uint64) - np.uint64(2**63)
    ).view(np.int64)


def to_step(value: np.ndarray) -> np.ndarray:
    """Real steps (2, N) in units of the box as integers in units of 2⁻⁶⁴, whole boxes left out.

    Raises:
        PackingError: a step is NaN or infinite.
    """
    bad = np.flatnonzero(~np.isfinite(value).all(axis=0))
    if len(bad):
        raise PackingError(
            f"the step of grain {bad[0]}: expected finite numbers, got {value[:, bad[0]]} boxes"
        )
    step = np.rint((value - np.rint(value)) * 2.0**64)
    # Half a box, 2⁶³, is one more than an integer holds; it is also half a box back.
    return np.where(step < 2.0**63, step, -(2.0**63)).astype(np.int64)


def check_grains(position: np.ndarray, diameter: np.ndarray, mass: np.ndarray) -> None:
    """Refuse positions (N, 2), diameters and masses (N,) that cannot be grains."""
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
    """Refuse rotations (N,), if there are any, that are NaN or infinite."""
    if rotation is None:
        return
    bad = np.flatnonzero(~np.isfinite(rotation))
    if len(bad):
        raise PackingError(
            f"rotation of grain {bad[0]}: expected a finite number, got {rotation[bad[0]]}"
        )


def check_springs(history: History | None) -> None:
    """Refuse a history, if there is one, with a spring state that is NaN or infinite."""
    if history is None:
        return
    bad = np.flatnonzero(~np.isfinite(history.spring_state))
    if len(bad):
        i, j, s = (getattr(history, x)[bad[0]] for x in ("i", "j", "spring_state"))
        raise PackingError(
            f"the spring between grains {i} and {j}: expected a finite number, got {s}"
        )


def check_box(diameter: np.ndarray, box_length: float, strain: float) -> None:
    """A touching pair must be the image that wrapping s to [−1/2, 1/2) finds: r √(1 + γ²) < L/2."""
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
