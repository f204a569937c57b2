"""Sharp Coulomb force: f_T = −h, dh = k ds up to |h| = μ f_N, where the contact slips.

The spring remembers a force, so that ∂f_T/∂ξ = 0 without slip. Energy h²/(2k). On harmonic
contacts, where k is constant, this is the sharp law again.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import (
    SLIDING_FRACTION,
    advance_spring,
    clip_to_coulomb,
    normal_response,
    slip_threshold,
    tangential_energy,
    tangential_response,
    tangential_scale,
)


class SharpCoulombForce(NamedTuple):
    """Tangential spring that remembers its force, cut at the Coulomb force μ f_N."""

    stiffness: float
    friction_coefficient: float


@implements(tangential_response, SharpCoulombForce)
def _force(tangential, normal, overlap, spring_state):
    force, stiffness = normal_response(normal, overlap)
    scale, _ = tangential_scale(normal, overlap)
    mu = tangential.friction_coefficient
    if abs(spring_state) >= SLIDING_FRACTION * mu * force:
        sign = math.copysign(1.0, spring_state)
        return -mu * force * sign, 0.0, -mu * stiffness * sign
    return -spring_state, -tangential.stiffness * scale, 0.0


@implements(advance_spring, SharpCoulombForce)
def _advance(tangential, normal, overlap, spring_state, slide):
    scale, _ = tangential_scale(normal, overlap)
    return spring_state + tangential.stiffness * scale * slide


@implements(slip_threshold, SharpCoulombForce)
def _threshold(tangential, normal, overlap):
    return tangential.friction_coefficient * normal_response(normal, overlap)[0]


@implements(clip_to_coulomb, SharpCoulombForce)
def _clip(tangential, normal, overlap, spring_state):
    limit = slip_threshold(tangential, normal, overlap)
    return min(max(spring_state, -limit), limit)


@implements(tangential_energy, SharpCoulombForce)
def _energy(tangential, normal, overlap, spring_state):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * spring_state * spring_state / (tangential.stiffness * scale)
