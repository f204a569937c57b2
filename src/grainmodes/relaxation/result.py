"""What every relaxation returns: the state, and how well it is balanced."""

from __future__ import annotations

from dataclasses import dataclass

from grainmodes.packing.state import Packing


@dataclass(frozen=True)
class Relaxed:
    """A relaxed packing; forces in k_N d^(3/2), `max_torque` scaled by 2/d, 0 without friction."""

    packing: Packing
    converged: bool
    iterations: int
    max_force: float
    max_torque: float = 0.0
