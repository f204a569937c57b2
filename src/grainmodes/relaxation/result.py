"""What every relaxation returns: the packing, and how well it is balanced."""

from __future__ import annotations

from dataclasses import dataclass

from grainmodes.packing.state import Packing


@dataclass(frozen=True)
class RelaxationResult:
    """A relaxed packing, whether it converged, and after how many iterations.

    `max_force` is max|F| and `max_torque` the largest scaled torque 2T/d, both in k_N d^(3/2);
    `max_torque` is 0 without friction.
    """

    packing: Packing
    converged: bool
    iterations: int
    max_force: float
    max_torque: float = 0.0
