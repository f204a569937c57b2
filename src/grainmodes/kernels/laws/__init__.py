"""Contact laws: the force between two touching grains and its derivatives, one law per module.

A law is a type. An interaction is a pair (normal law, tangential law). numba compiles every loop
for the types it meets, so a frictionless scene contains no tangential code at all.

| symbol (A, B, C)          | name here              |
| ------------------------- | ---------------------- |
| ξ_N, δ  overlap           | overlap                |
| s, ξ_T, t  tangential     | spring_state           |
| h  tangential force kept  | spring_state           |
| f_N, ∂f_N/∂ξ              | normal_response        |
| f_T, ∂f_T/∂s, ∂f_T/∂ξ     | tangential_response    |
| k_N, k_T                  | stiffness of each law  |
| μ                         | friction_coefficient   |
| s* = μ (k_N/k_T) ξ        | slip_threshold         |

`responses` lists the functions that a law implements. The tests compare every derivative with the
slow twin of its force. A type with a `friction_coefficient` is a Coulomb law.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from grainmodes.kernels.laws.elastic import Elastic
from grainmodes.kernels.laws.elastic_force import ElasticForce
from grainmodes.kernels.laws.frictionless import Frictionless
from grainmodes.kernels.laws.harmonic import Harmonic
from grainmodes.kernels.laws.hertz import Hertz
from grainmodes.kernels.laws.responses import (
    SLIDING_FRACTION,
    NormalLaw,
    TangentialLaw,
    advance_spring,
    clip_to_coulomb,
    normal_energy,
    normal_response,
    slip_threshold,
    tangential_energy,
    tangential_response,
    tangential_scale,
)
from grainmodes.kernels.laws.sharp_coulomb import SharpCoulomb
from grainmodes.kernels.laws.sharp_coulomb_force import SharpCoulombForce
from grainmodes.kernels.laws.smoothed_coulomb import SmoothedCoulomb
from grainmodes.parameters.law import ContactLaw

__all__ = [
    "NORMAL",
    "SLIDING_FRACTION",
    "TANGENTIAL",
    "Elastic",
    "ElasticForce",
    "Frictionless",
    "Harmonic",
    "Hertz",
    "Interaction",
    "NormalLaw",
    "SharpCoulomb",
    "SharpCoulombForce",
    "SmoothedCoulomb",
    "TangentialLaw",
    "advance_spring",
    "clip_to_coulomb",
    "normal_energy",
    "normal_response",
    "slip_threshold",
    "tangential_energy",
    "tangential_response",
    "tangential_scale",
]

NORMAL: dict[str, Callable[[float], NormalLaw]] = {"hertz": Hertz, "harmonic": Harmonic}
TANGENTIAL: dict[str, Callable[..., TangentialLaw]] = {
    "elastic": Elastic,
    "elastic_force": ElasticForce,
    "smoothed_coulomb": SmoothedCoulomb,
    "sharp_coulomb": SharpCoulomb,
    "sharp_coulomb_force": SharpCoulombForce,
}
"""Name of a law → its type."""


class Interaction(NamedTuple):
    """The compiled contact law: a normal and a tangential law."""

    normal: NormalLaw
    tangential: TangentialLaw

    @classmethod
    def from_law(cls, law: ContactLaw) -> Interaction:
        """The interaction of a scene's contact law, with k_N = 1; k_T = 0 is frictionless.

        Raises:
            ValueError: an unknown law, a negative k_T, or a Coulomb law without its coefficient.
        """
        if law.normal not in NORMAL:
            raise ValueError(f"normal law: expected one of {', '.join(NORMAL)}, got {law.normal!r}")
        if not law.kt >= 0.0:
            raise ValueError(f"kt: expected a tangential stiffness of 0 or more, got {law.kt}")
        return cls(NORMAL[law.normal](1.0), _tangential(law))


def _tangential(law: ContactLaw) -> TangentialLaw:
    if not law.frictional:
        return Frictionless()
    if law.tangential not in TANGENTIAL:
        expected = ", ".join(TANGENTIAL)
        raise ValueError(f"tangential law: expected one of {expected}, got {law.tangential!r}")
    law_type = TANGENTIAL[law.tangential]
    if not hasattr(law_type, "friction_coefficient"):
        return law_type(float(law.kt))
    if law.friction_coefficient is None or not law.friction_coefficient > 0.0:
        raise ValueError(
            f"friction_coefficient of {law.tangential}: expected a positive number, "
            f"got {law.friction_coefficient}"
        )
    return law_type(float(law.kt), float(law.friction_coefficient))
