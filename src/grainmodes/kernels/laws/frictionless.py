"""Frictionless: rotation, torque and history do not exist."""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import tangential_energy


class Frictionless(NamedTuple):
    """No tangential force: rotation, torque and history do not exist."""


@implements(tangential_energy, Frictionless)
def _energy(tangential, normal, overlap, displacement):
    return 0.0
