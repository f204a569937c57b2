"""Elastic force: f_T = −h, dh = k ds, energy h²/(2k); `mindlin/force` of LAMMPS.

The spring remembers a force, so that a later change of the overlap leaves it alone: ∂f_T/∂ξ = 0. On
harmonic contacts, where k is constant, this is the elastic law again.
"""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import (
    advanced,
    tangential_energy,
    tangential_response,
    tangential_scale,
)


class ElasticForce(NamedTuple):
    """Tangential spring that never slips and remembers its force."""

    stiffness: float


@implements(tangential_response, ElasticForce)
def _force(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return -displacement, -tangential.stiffness * scale, 0.0


@implements(advanced, ElasticForce)
def _advanced(tangential, normal, overlap, displacement, slide):
    scale, _ = tangential_scale(normal, overlap)
    return displacement + tangential.stiffness * scale * slide


@implements(tangential_energy, ElasticForce)
def _energy(tangential, normal, overlap, displacement):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * displacement * displacement / (tangential.stiffness * scale)
