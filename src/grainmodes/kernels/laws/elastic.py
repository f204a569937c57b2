"""Elastic: f_T = −k s, k = k_T w(ξ), energy k s²/2: A (8), sign of (D2) corrected; B."""

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
def _force(tangential, normal, overlap, spring_state):
    scale, slope = tangential_scale(normal, overlap)
    k, s = tangential.stiffness, spring_state
    return -k * scale * s, -k * scale, -k * slope * s


@implements(tangential_energy, Elastic)
def _energy(tangential, normal, overlap, spring_state):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * tangential.stiffness * scale * spring_state * spring_state
