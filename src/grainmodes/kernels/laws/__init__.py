"""Contact laws: the force between two touching grains and its derivatives, one law a module.

A law is a type. An interaction is a pair (normal law, tangential law); numba compiles every loop
for the types it meets, so a frictionless scene holds no tangential code at all.

| symbol (A, B, C)          | name here              |
| ------------------------- | ---------------------- |
| ξ_N, δ  overlap           | overlap                |
| s, ξ_T, t  tangential     | displacement           |
| h  tangential force kept  | displacement           |
| f_N, ∂f_N/∂ξ              | normal_response        |
| f_T, ∂f_T/∂s, ∂f_T/∂ξ     | tangential_response    |
| k_N, k_T                  | stiffness of each law  |
| μ                         | friction_coefficient   |
| s* = μ (k_N/k_T) ξ        | threshold              |

What a law answers: `responses`. Every derivative is tested against central differences of the
force. A type with a `friction_coefficient` is a Coulomb law.
"""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.laws.elastic import Elastic
from grainmodes.kernels.laws.elastic_force import ElasticForce
from grainmodes.kernels.laws.frictionless import Frictionless
from grainmodes.kernels.laws.harmonic import Harmonic
from grainmodes.kernels.laws.hertz import Hertz
from grainmodes.kernels.laws.responses import (
    AT_THRESHOLD,
    admissible,
    advanced,
    normal_energy,
    normal_response,
    tangential_energy,
    tangential_response,
    tangential_scale,
    threshold,
)
from grainmodes.kernels.laws.sharp_coulomb import SharpCoulomb
from grainmodes.kernels.laws.sharp_coulomb_force import SharpCoulombForce
from grainmodes.kernels.laws.smoothed_coulomb import SmoothedCoulomb
from grainmodes.parameters.law import ContactLaw

__all__ = [
    "AT_THRESHOLD",
    "NORMAL",
    "TANGENTIAL",
    "Elastic",
    "ElasticForce",
    "Frictionless",
    "Harmonic",
    "Hertz",
    "Interaction",
    "SharpCoulomb",
    "SharpCoulombForce",
    "SmoothedCoulomb",
    "admissible",
    "advanced",
    "interaction",
    "normal_energy",
    "normal_response",
    "tangential_energy",
    "tangential_response",
    "tangential_scale",
    "threshold",
]

NORMAL = {"hertz": Hertz, "harmonic": Harmonic}
TANGENTIAL = {
    "elastic": Elastic,
    "elastic_force": ElasticForce,
    "smoothed_coulomb": SmoothedCoulomb,
    "sharp_coulomb": SharpCoulomb,
    "sharp_coulomb_force": SharpCoulombForce,
}
"""Name of a law → its type."""


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
    if law.tangential not in TANGENTIAL:
        allowed = ", ".join(TANGENTIAL)
        raise ValueError(f"tangential law {law.tangential!r}: allowed are {allowed}")
    kind = TANGENTIAL[law.tangential]
    if "friction_coefficient" not in kind._fields:
        return kind(float(law.kt))
    if law.friction_coefficient is None or not law.friction_coefficient > 0.0:
        raise ValueError(
            f"friction_coefficient = {law.friction_coefficient}: {law.tangential} needs a "
            "positive number"
        )
    return kind(float(law.kt), float(law.friction_coefficient))
