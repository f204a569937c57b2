"""Sharp Coulomb: f_T = −k s up to |s| = s*, where k s* = μ f_N and the contact slips: C, Sec. VIII.

At s* the force is −μ f_N sign(s). Energy k s²/2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import (
    SLIDING_FRACTION,
    clip_to_coulomb,
    normal_response,
    slip_threshold,
    tangential_energy,
    tangential_response,
    tangential_scale,
)


class SharpCoulomb(NamedTuple):
    """Tangential spring cut at the Coulomb force μ f_N."""

    stiffness: float
    friction_coefficient: float


@implements(tangential_response, SharpCoulomb)
def _force(tangential, normal, overlap, spring_state):
    force, stiffness = normal_response(normal, overlap)
    scale, slope = tangential_scale(normal, overlap)
    k, s, mu = tangential.stiffness, spring_state, tangential.friction_coefficient
    if k * scale * abs(s) >= SLIDING_FRACTION * mu * force:
        sign = math.copysign(1.0, s)
        return -mu * force * sign, 0.0, -mu * stiffness * sign
    return -k * scale * s, -k * scale, -k * slope * s


@implements(slip_threshold, SharpCoulomb)
def _threshold(tangential, normal, overlap):
    force, _ = normal_response(normal, overlap)
    scale, _ = tangential_scale(normal, overlap)
    return tangential.friction_coefficient * force / (tangential.stiffness * scale)


@implements(clip_to_coulomb, SharpCoulomb)
def _clip(tangential, normal, overlap, spring_state):
    limit = slip_threshold(tangential, normal, overlap)
    return min(max(spring_state, -limit), limit)


@implements(tangential_energy, SharpCoulomb)
def _energy(tangential, normal, overlap, spring_state):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * tangential.stiffness * scale * spring_state * spring_state
