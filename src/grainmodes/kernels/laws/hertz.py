"""Hertz: f_N = k_N ξ^(3/2), tangential stiffness k_T ξ^(1/2), energy (2/5) k_N ξ^(5/2).

A (7), (8); C (4), (6).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from grainmodes.kernels.compiler import implements
from grainmodes.kernels.laws.responses import normal_energy, normal_response, tangential_scale


class Hertz(NamedTuple):
    """Normal force k_N ξ^(3/2)."""

    stiffness: float


@implements(normal_response, Hertz)
def _force(normal, overlap):
    root = math.sqrt(overlap)
    return normal.stiffness * overlap * root, 1.5 * normal.stiffness * root


@implements(tangential_scale, Hertz)
def _scale(normal, overlap):
    root = math.sqrt(overlap)
    return root, 0.5 / root


@implements(normal_energy, Hertz)
def _energy(normal, overlap):
    return 0.4 * normal.stiffness * overlap * overlap * math.sqrt(overlap)
