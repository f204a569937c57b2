"""Smoothed Coulomb: f_T = −k s (1 + τ − τ²), τ = |s|/s* < 1, s* = μ (k_N/k_T) ξ: C (8).

Beyond s* the force is −μ f_N sign(s), which is reached with slope zero. The energy is
k s² (1/2 + τ/3 − τ²/4) up to s*, and grows beyond by μ f_N per length. The spring remembers all
of s.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import (
    normal_response,
    slip_threshold,
    tangential_energy,
    tangential_response,
    tangential_scale,
)


class SmoothedCoulomb(NamedTuple):
    """Tangential spring that softens to the Coulomb force μ f_N (differentiable at s*)."""

    stiffness: float
    friction_coefficient: float


@implements(slip_threshold, SmoothedCoulomb)
def _threshold(tangential, normal, overlap):
    softness = normal.stiffness / tangential.stiffness
    return tangential.friction_coefficient * softness * overlap


@implements(tangential_response, SmoothedCoulomb)
def _force(tangential, normal, overlap, spring_state):
    force, stiffness = normal_response(normal, overlap)
    scale, slope = tangential_scale(normal, overlap)
    k, s, mu = tangential.stiffness, spring_state, tangential.friction_coefficient
    tau = abs(s) / slip_threshold(tangential, normal, overlap)
    if tau >= 1.0:
        sign = math.copysign(1.0, s)
        return -mu * force * sign, 0.0, -mu * stiffness * sign
    shape = 1.0 + tau - tau * tau
    # τ ∝ 1/ξ at fixed s, hence ∂(shape)/∂ξ = −(1 − 2τ) τ / ξ.
    return (
        -k * scale * s * shape,
        -k * scale * (1.0 + 2.0 * tau - 3.0 * tau * tau),
        -k * s * (slope * shape - scale * (1.0 - 2.0 * tau) * tau / overlap),
    )


@implements(tangential_energy, SmoothedCoulomb)
def _energy(tangential, normal, overlap, spring_state):
    force, _ = normal_response(normal, overlap)
    scale, _ = tangential_scale(normal, overlap)
    slips_at = slip_threshold(tangential, normal, overlap)
    tau = min(abs(spring_state) / slips_at, 1.0)
    s = tau * slips_at
    stored = tangential.stiffness * scale * s * s * (0.5 + tau / 3.0 - 0.25 * tau * tau)
    return stored + tangential.friction_coefficient * force * (abs(spring_state) - s)
