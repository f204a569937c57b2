"""Sharp Coulomb force: f_T = −h, dh = k ds up to |h| = μ f_N, where the rest slips.

The spring remembers a force: without slip ∂f_T/∂ξ = 0. Energy h²/(2k). On harmonic contacts, where
k is constant, this is the sharp law again.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import (
    AT_THRESHOLD,
    admissible,
    advanced,
    normal_response,
    tangential_energy,
    tangential_response,
    tangential_scale,
    threshold,
)


class SharpCoulombForce(NamedTuple):
    """Tangential spring that remembers its force, cut at the Coulomb force μ f_N."""

    stiffness: float
    friction_coefficient: float


@implements(tangential_response, SharpCoulombForce)
def _force(tangential, normal, overlap, displacement):
    force, stiffness = normal_response(normal, overlap)
    scale, _ = tangential_scale(normal, overlap)
    mu = tangential.friction_coefficient
    if abs(displacement) >= AT_THRESHOLD * mu * force:
        sign = math.copysign(1.0, displacement)
        return -mu * force * sign, 0.0, -mu * stiffness * sign
    return -displacement, -tangential.stiffness * scale, 0.0


@implements(advanced, SharpCoulombForce)
def _advanced(tangential, normal, overlap, displacement, slide):
    scale, _ = tangential_scale(normal, overlap)
    return displacement + tangential.stiffness * scale * slide


@implements(threshold, SharpCoulombForce)
def _threshold(tangential, normal, overlap):
    return tangential.friction_coefficient * normal_response(normal, overlap)[0]


@implements(admissible, SharpCoulombForce)
def _kept(tangential, normal, overlap, displacement):
    limit = threshold(tangential, normal, overlap)
    return min(max(displacement, -limit), limit)


@implements(tangential_energy, SharpCoulombForce)
def _energy(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * displacement * displacement / (tangential.stiffness * scale)
