"""Harmonic: f_N = k_N ξ, tangential stiffness k_T, energy k_N ξ²/2 (B)."""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import normal_energy, normal_response, tangential_scale


class Harmonic(NamedTuple):
    """Normal force k_N ξ."""

    stiffness: float


@implements(normal_response, Harmonic)
def _force(normal, overlap):
    return normal.stiffness * overlap, normal.stiffness


@implements(tangential_scale, Harmonic)
def _scale(normal, overlap):
    return 1.0, 0.0


@implements(normal_energy, Harmonic)
def _energy(normal, overlap):
    return 0.5 * normal.stiffness * overlap * overlap
