"""Net normal forces of a frictionless packing: the inner loop of every compression.

    F_i = Σ_j f_N(ξ_ij) n_ij,    ξ_ij = (d_i + d_j)/2 − r_ij          A (A4)

There is one loop over the pairs, with a branch that is predicted well: near a balance the same
pairs touch step after step. Pair forces without a branch, in blocks that fit the first-level cache,
vectorise and took 1.6 times as long on an x86-64 server, at φ = 0.90 and skin 0.2
(`measurements/benchmarks/twin.py`). At γ = 0 the loop is compiled without the term of the shear,
which cost 4 % among 65536 grains.
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.laws import normal_response
from grainmodes.kernels.neighbours import FRACTION_UNIT, separation


@kernel
def repulsion(x, y, box_length, strain, neighbours, normal, force_x, force_y):
    """Add the net force on every grain to force_x and force_y, both (N,), in k_N d^(3/2)."""
    if strain == 0.0:
        add_forces(x, y, box_length, None, neighbours, normal, force_x, force_y)
    else:
        add_forces(x, y, box_length, strain, neighbours, normal, force_x, force_y)


@kernel
def add_forces(x, y, box_length, strain, neighbours, normal, force_x, force_y):
    """Add the net forces; `strain` is None in a box that is not sheared."""
    scale = box_length * FRACTION_UNIT
    left, right, contact_distance = neighbours.left, neighbours.right, neighbours.contact_distance
    for pair in range(left.shape[0]):
        i, j = left[pair], right[pair]
        dx, dy = separation(x, y, i, j, scale, strain)
        square = dx * dx + dy * dy
        if square < contact_distance[pair] * contact_distance[pair]:
            distance = math.sqrt(square)
            force, _ = normal_response(normal, contact_distance[pair] - distance)
            force_x[i] += force / distance * dx
            force_y[i] += force / distance * dy
            force_x[j] -= force / distance * dx
            force_y[j] -= force / distance * dy


@kernel
def mean_force_and_stiffness(x, y, box_length, strain, neighbours, normal):
    """(mean contact force, twice the largest sum of contact stiffnesses on a grain).

    The second is an upper bound of the largest eigenvalue of the Hessian (Gershgorin), which limits
    the time step of FIRE.
    """
    total, contacts = 0.0, 0
    stiffness = np.zeros(x.shape[0])
    for pair in range(neighbours.left.shape[0]):
        i, j = neighbours.left[pair], neighbours.right[pair]
        dx, dy = separation(x, y, i, j, box_length * FRACTION_UNIT, strain)
        overlap = neighbours.contact_distance[pair] - math.sqrt(dx * dx + dy * dy)
        if overlap > 0.0:
            force, slope = normal_response(normal, overlap)
            total += force
            contacts += 1
            stiffness[i] += slope
            stiffness[j] += slope
    return total / max(contacts, 1), 2.0 * stiffness.max()
