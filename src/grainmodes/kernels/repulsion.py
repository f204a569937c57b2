"""Net normal forces of a frictionless packing: the inner loop of every compression.

    F_i = Σ_j f_N(ξ_ij) n_ij,    ξ_ij = (d_i + d_j)/2 − r_ij          A (A4)

Two passes over a block of grains that fits the first-level cache: the first computes the force of
every pair (gathers and arithmetic only, so it vectorises), the second adds them to the grains.
Pairs that do not touch have ξ = 0 and add nothing; a branch would cost more.
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.laws import normal_response
from grainmodes.kernels.neighbours import RESOLUTION, separation

BLOCK = 256
"""Grains per block: about 800 pairs, 13 kB of pair forces."""


@kernel
def pair_forces(x, y, scale, strain, neighbours, begin, normal, force_x, force_y):
    """Forces of pairs begin … begin + len(force_x) − 1 on their left grain."""
    left, right, reach = neighbours.left, neighbours.right, neighbours.reach
    for k in range(force_x.shape[0]):
        pair = begin + k
        dx, dy = separation(x, y, left[pair], right[pair], scale, strain)
        distance = math.sqrt(dx * dx + dy * dy)
        force, _ = normal_response(normal, max(reach[pair] - distance, 0.0))
        force_x[k] = force / distance * dx
        force_y[k] = force / distance * dy


@kernel
def add_to_grains(neighbours, begin, end, pair_x, pair_y, force_x, force_y):
    """Add the pair forces of grains begin … end − 1 to both partners."""
    first, right = neighbours.first, neighbours.right
    base = first[begin]
    for i in range(begin, end):
        sum_x, sum_y = 0.0, 0.0
        for pair in range(first[i], first[i + 1]):
            j = right[pair]
            fx, fy = pair_x[pair - base], pair_y[pair - base]
            sum_x += fx
            sum_y += fy
            force_x[j] -= fx
            force_y[j] -= fy
        force_x[i] += sum_x
        force_y[i] += sum_y


@kernel
def pair_scratch(neighbours, components):
    """Room for the pair forces of the fullest block; shape (components, P_max)."""
    first = neighbours.first
    n = first.shape[0] - 1
    widest = 0
    for begin in range(0, n, BLOCK):
        widest = max(widest, first[min(begin + BLOCK, n)] - first[begin])
    return np.empty((components, widest))


@kernel
def repulsion(x, y, box_length, strain, neighbours, normal, scratch, force_x, force_y):
    """Add the net force on every grain to force_x and force_y, both (N,), in k_N d^(3/2)."""
    n = x.shape[0]
    scale = box_length * RESOLUTION
    for begin in range(0, n, BLOCK):
        end = min(begin + BLOCK, n)
        low, high = neighbours.first[begin], neighbours.first[end]
        pair_x, pair_y = scratch[0, : high - low], scratch[1, : high - low]
        pair_forces(x, y, scale, strain, neighbours, low, normal, pair_x, pair_y)
        add_to_grains(neighbours, begin, end, pair_x, pair_y, force_x, force_y)


@kernel
def load(x, y, box_length, strain, neighbours, normal):
    """(mean contact force, twice the largest sum of contact stiffnesses on a grain).

    The second bounds the largest eigenvalue of the Hessian from above (Gershgorin): what limits
    the time step of FIRE.
    """
    total, contacts = 0.0, 0
    stiffness = np.zeros(x.shape[0])
    for pair in range(neighbours.left.shape[0]):
        i, j = neighbours.left[pair], neighbours.right[pair]
        dx, dy = separation(x, y, i, j, box_length * RESOLUTION, strain)
        overlap = neighbours.reach[pair] - math.sqrt(dx * dx + dy * dy)
        if overlap > 0.0:
            force, slope = normal_response(normal, overlap)
            total += force
            contacts += 1
            stiffness[i] += slope
            stiffness[j] += slope
    return total / max(contacts, 1), 2.0 * stiffness.max()
