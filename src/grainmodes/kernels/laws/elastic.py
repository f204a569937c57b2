"""Elastic: f_T = −k s, k = k_T w(ξ), energy k s²/2: A (8), sign of (D2) mended; B."""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import (
    tangential_energy,
    tangential_response,
    tangential_scale,
)


class Elastic(NamedTuple):
    """Tangential spring that never slips."""

    stiffness: float


@implements(tangential_response, Elastic)
def _force(tangential, normal, overlap, displacement):
    scale, slope = tangential_scale(normal, overlap)
    k, s = tangential.stiffness, displacement
    return -k * scale * s, -k * scale, -k * slope * s


@implements(tangential_energy, Elastic)
def _energy(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * tangential.stiffness * scale * displacement * displacement
