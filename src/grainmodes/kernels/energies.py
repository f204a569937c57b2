"""The energy that a contact stores: the work of its normal force since first touch, and of its
tangential force from s = 0 on, at this overlap.

    Hertz      (2/5) k_N ξ^(5/2)          harmonic   k_N ξ²/2
    elastic    k s²/2                     sharp      k s²/2, |s| ≤ s*
    smoothed   k s² (1/2 + τ/3 − τ²/4), τ = |s|/s* ≤ 1;   beyond, μ f_N for every further |s|
    elastic and sharp force    h²/(2k)

with k = k_T w(ξ). Only without friction, and for harmonic elastic contacts, are the contact forces
the gradient of this energy.
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.compiler import implements, kernel
from grainmodes.kernels.contacts import remembered
from grainmodes.kernels.laws import (
    Elastic,
    ElasticForce,
    Frictionless,
    Harmonic,
    Hertz,
    SharpCoulomb,
    SharpCoulombForce,
    SmoothedCoulomb,
    normal_response,
    tangential_scale,
)


def normal_energy(normal, overlap):
    """Energy of the normal spring."""
    raise NotImplementedError("called from compiled code only")


def tangential_energy(tangential, normal, overlap, displacement):
    """Energy of the tangential spring."""
    raise NotImplementedError("called from compiled code only")


@implements(normal_energy, Hertz)
def _hertz(normal, overlap):
    return 0.4 * normal.stiffness * overlap * overlap * math.sqrt(overlap)


@implements(normal_energy, Harmonic)
def _harmonic(normal, overlap):
    return 0.5 * normal.stiffness * overlap * overlap


@implements(tangential_energy, Frictionless)
def _frictionless(tangential, normal, overlap, displacement):
    return 0.0


@implements(tangential_energy, Elastic)
def _elastic(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * tangential.stiffness * scale * displacement * displacement


@implements(tangential_energy, SharpCoulomb)
def _sharp(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * tangential.stiffness * scale * displacement * displacement


@implements(tangential_energy, ElasticForce)
def _elastic_force(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * displacement * displacement / (tangential.stiffness * scale)


@implements(tangential_energy, SharpCoulombForce)
def _sharp_force(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * displacement * displacement / (tangential.stiffness * scale)


@implements(tangential_energy, SmoothedCoulomb)
def _smoothed(tangential, normal, overlap, displacement):
    force, _ = normal_response(normal, overlap)
    scale, _ = tangential_scale(normal, overlap)
    mu = tangential.friction_coefficient
    threshold = mu * normal.stiffness / tangential.stiffness * overlap
    tau = min(abs(displacement) / threshold, 1.0)
    s = tau * threshold
    stored = tangential.stiffness * scale * s * s * (0.5 + tau / 3.0 - 0.25 * tau * tau)
    return stored + mu * force * (abs(displacement) - s)


@kernel
def contact_energies(interaction, overlap, displacement):
    """Energy of every contact, (C,) in k_N d^(5/2) (Hertz) or k_N d² (harmonic)."""
    energy = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        energy[c] = normal_energy(interaction.normal, overlap[c]) + tangential_energy(
            interaction.tangential, interaction.normal, overlap[c], remembered(displacement, c)
        )
    return energy
