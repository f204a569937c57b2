"""Elastic force: f_T = −h, dh = k ds, energy h²/(2k); `mindlin/force` of LAMMPS.

The spring remembers a force, which a later change of the overlap does not change: ∂f_T/∂ξ = 0. On
harmonic contacts, where k is constant, this is the elastic law again.
"""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import (
    advance_spring,
    tangential_energy,
    tangential_response,
    tangential_scale,
)


class ElasticForce(NamedTuple):
    """Tangential spring that never slips and remembers its force."""

    stiffness: float


@implements(tangential_response, ElasticForce)
def _force(tangential, normal, overlap, spring_state):
    scale, _ = tangential_scale(normal, overlap)
    return -spring_state, -tangential.stiffness * scale, 0.0


@implements(advance_spring, ElasticForce)
def _advance(tangential, normal, overlap, spring_state, slide):
    scale, _ = tangential_scale(normal, overlap)
    return spring_state + tangential.stiffness * scale * slide


@implements(tangential_energy, ElasticForce)
def _energy(tangential, normal, overlap, spring_state):
    scale, _ = tangential_scale(normal, overlap)
    return 0.5 * spring_state * spring_state / (tangential.stiffness * scale)
