"""Frictionless: rotation, torque and history do not exist."""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import tangential_energy


class Frictionless(NamedTuple):
    """No tangential force: rotation, torque and history do not exist."""

    @property
    def stiffness(self) -> float:
        """k_T = 0."""
        return 0.0


@implements(tangential_energy, Frictionless)
def _energy(tangential, normal, overlap, spring_state):
    return 0.0
