"""Contact laws: the force between two touching grains and its derivatives.

A law is a type. An interaction is a pair (normal law, tangential law); numba compiles every loop
for the types it meets, so a frictionless scene holds no tangential code at all.

| symbol (A, B, C)          | name here              |
| ------------------------- | ---------------------- |
| ξ_N, δ  overlap           | overlap                |
| s, ξ_T, t  tangential     | displacement           |
| f_N, ∂f_N/∂ξ              | normal_response        |
| h  tangential force kept  | displacement           |
| f_T, ∂f_T/∂s, ∂f_T/∂ξ     | tangential_response    |
| k_N, k_T                  | stiffness of each law  |
| μ                         | friction_coefficient   |
| s* = μ (k_N/k_T) ξ        | threshold              |

    Hertz      f_N = k_N ξ^(3/2)     tangential stiffness k_T ξ^(1/2)     A (7), (8); C (4), (6)
    harmonic   f_N = k_N ξ           tangential stiffness k_T             B

    elastic    f_T = −k s                                                 A (8), sign of (D2) mended
    smoothed   f_T = −k s (1 + τ − τ²), τ = |s|/s*; −μ f_N sign(s) for τ ≥ 1        C (8)
    sharp      f_T = −k s for τ < 1; −μ f_N sign(s) for τ ≥ 1                  C, Sec. VIII

    elastic force     f_T = −h,  dh = k ds                   `mindlin/force` of LAMMPS
    sharp force       f_T = −h,  −μ f_N sign(h) for |h| ≥ μ f_N

with k the tangential stiffness of the normal law. The last two remember a force h where the others
remember s, so that ∂f_T/∂ξ = 0 without slip; on harmonic contacts, where k is constant, they are
the elastic and the sharp law again. How each remembers: `springs`. Every derivative here is tested
against central differences of the force.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.parameters.law import ContactLaw

AT_THRESHOLD = 1.0 - 1e-12
"""Part of s* from which a contact slides: a spring that has slipped is held at s* to rounding."""


class Hertz(NamedTuple):
    """Normal force k_N ξ^(3/2)."""

    stiffness: float


class Harmonic(NamedTuple):
    """Normal force k_N ξ."""

    stiffness: float


class Frictionless(NamedTuple):
    """No tangential force: rotation, torque and history do not exist."""


class Elastic(NamedTuple):
    """Tangential spring that never slips."""

    stiffness: float


class SmoothedCoulomb(NamedTuple):
    """Tangential spring that softens to the Coulomb force μ f_N (differentiable at s*)."""

    stiffness: float
    friction_coefficient: float


class SharpCoulomb(NamedTuple):
    """Tangential spring cut at the Coulomb force μ f_N."""

    stiffness: float
    friction_coefficient: float


class ElasticForce(NamedTuple):
    """Tangential spring that never slips and remembers its force."""

    stiffness: float


class SharpCoulombForce(NamedTuple):
    """Tangential spring that remembers its force, cut at the Coulomb force μ f_N."""

    stiffness: float
    friction_coefficient: float


class Interaction(NamedTuple):
    """A normal and a tangential law."""

    normal: tuple
    tangential: tuple


def interaction(law: ContactLaw) -> Interaction:
    """The interaction of a contact law with k_N = 1; k_T = 0 is frictionless.

    Raises:
        ValueError: an unknown law, a negative k_T, or a Coulomb law without its coefficient.
    """
    if law.normal not in NORMAL:
        raise ValueError(f"normal law {law.normal!r}: allowed are {', '.join(NORMAL)}")
    if not law.kt >= 0.0:
        raise ValueError(f"kt = {law.kt}: the tangential stiffness must be 0 or positive")
    return Interaction(NORMAL[law.normal](1.0), _tangential(law))


def _tangential(law: ContactLaw):
    if not law.frictional:
        return Frictionless()
    if law.tangential in ELASTIC:
        return ELASTIC[law.tangential](float(law.kt))
    if law.tangential not in COULOMB:
        allowed = ", ".join((*ELASTIC, *COULOMB))
        raise ValueError(f"tangential law {law.tangential!r}: allowed are {allowed}")
    if law.friction_coefficient is None or not law.friction_coefficient > 0.0:
        raise ValueError(
            f"friction_coefficient = {law.friction_coefficient}: {law.tangential} needs a "
            "positive number"
        )
    return COULOMB[law.tangential](float(law.kt), float(law.friction_coefficient))


NORMAL = {"hertz": Hertz, "harmonic": Harmonic}
ELASTIC = {"elastic": Elastic, "elastic_force": ElasticForce}
COULOMB = {
    "smoothed_coulomb": SmoothedCoulomb,
    "sharp_coulomb": SharpCoulomb,
    "sharp_coulomb_force": SharpCoulombForce,
}


def normal_response(normal, overlap):
    """(f_N, ∂f_N/∂ξ) of a contact."""
    raise NotImplementedError("called from compiled code only")


def tangential_scale(normal, overlap):
    """(w, ∂w/∂ξ) where the tangential stiffness is k_T w(ξ)."""
    raise NotImplementedError("called from compiled code only")


def tangential_response(tangential, normal, overlap, displacement):
    """(f_T, ∂f_T/∂s, ∂f_T/∂ξ) of a contact; `displacement` is what its spring remembers, s or h."""
    raise NotImplementedError("called from compiled code only")


@implements(normal_response, Hertz)
def _hertz(normal, overlap):
    root = math.sqrt(overlap)
    return normal.stiffness * overlap * root, 1.5 * normal.stiffness * root


@implements(normal_response, Harmonic)
def _harmonic(normal, overlap):
    return normal.stiffness * overlap, normal.stiffness


@implements(tangential_scale, Hertz)
def _hertz_scale(normal, overlap):
    root = math.sqrt(overlap)
    return root, 0.5 / root


@implements(tangential_scale, Harmonic)
def _harmonic_scale(normal, overlap):
    return 1.0, 0.0


@implements(tangential_response, Elastic)
def _elastic(tangential, normal, overlap, displacement):
    scale, slope = tangential_scale(normal, overlap)
    k, s = tangential.stiffness, displacement
    return -k * scale * s, -k * scale, -k * slope * s


@implements(tangential_response, SmoothedCoulomb)
def _smoothed(tangential, normal, overlap, displacement):
    force, stiffness = normal_response(normal, overlap)
    scale, slope = tangential_scale(normal, overlap)
    k, s, mu = tangential.stiffness, displacement, tangential.friction_coefficient
    threshold = mu * normal.stiffness / k * overlap
    tau = abs(s) / threshold
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


@implements(tangential_response, SharpCoulomb)
def _sharp(tangential, normal, overlap, displacement):
    force, stiffness = normal_response(normal, overlap)
    scale, slope = tangential_scale(normal, overlap)
    k, s, mu = tangential.stiffness, displacement, tangential.friction_coefficient
    if k * scale * abs(s) >= AT_THRESHOLD * mu * force:
        sign = math.copysign(1.0, s)
        return -mu * force * sign, 0.0, -mu * stiffness * sign
    return -k * scale * s, -k * scale, -k * slope * s


@implements(tangential_response, ElasticForce)
def _elastic_force(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return -displacement, -tangential.stiffness * scale, 0.0


@implements(tangential_response, SharpCoulombForce)
def _sharp_force(tangential, normal, overlap, displacement):
    force, stiffness = normal_response(normal, overlap)
    scale, _ = tangential_scale(normal, overlap)
    mu = tangential.friction_coefficient
    if abs(displacement) >= AT_THRESHOLD * mu * force:
        sign = math.copysign(1.0, displacement)
        return -mu * force * sign, 0.0, -mu * stiffness * sign
    return -displacement, -tangential.stiffness * scale, 0.0
