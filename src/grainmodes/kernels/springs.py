"""What a tangential spring remembers: how it advances with ds, and how much the law lets it keep.

| remembered           | advances by                                | keeps                        |
| -------------------- | ------------------------------------------ | ---------------------------- |
| s  displacement      | ds                                         | all; sharp Coulomb: |s| ≤ s* |
| h  force             | k_T w(ξ) ds, ξ at the middle of the step   | all; sharp Coulomb: μ f_N    |

A displacement feels every later change of the overlap, f_T = −k_T w(ξ) s; a force does not, and so
∂f_T/∂ξ = 0. LAMMPS calls the two `mindlin` and `mindlin/force`.
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.compiler import implements, kernel, otherwise
from grainmodes.kernels.laws import (
    ElasticForce,
    SharpCoulomb,
    SharpCoulombForce,
    normal_response,
    tangential_scale,
)


def advanced(tangential, normal, overlap, displacement, slide):
    """What a spring remembers after it has slid by ds, with ξ at the middle of the step."""
    raise NotImplementedError("called from compiled code only")


def admissible(tangential, normal, overlap, displacement):
    """What the law lets the spring keep: sharp Coulomb lets the rest slip."""
    raise NotImplementedError("called from compiled code only")


@otherwise(advanced)
def _displacement_advances(tangential, normal, overlap, displacement, slide):
    return displacement + slide


@implements(advanced, ElasticForce)
def _elastic_force_advances(tangential, normal, overlap, displacement, slide):
    scale, _ = tangential_scale(normal, overlap)
    return displacement + tangential.stiffness * scale * slide


@implements(advanced, SharpCoulombForce)
def _sharp_force_advances(tangential, normal, overlap, displacement, slide):
    scale, _ = tangential_scale(normal, overlap)
    return displacement + tangential.stiffness * scale * slide


@otherwise(admissible)
def _keeps_all(tangential, normal, overlap, displacement):
    return displacement


@implements(admissible, SharpCoulomb)
def _sharp_keeps(tangential, normal, overlap, displacement):
    force, _ = normal_response(normal, overlap)
    scale, _ = tangential_scale(normal, overlap)
    limit = tangential.friction_coefficient * force / (tangential.stiffness * scale)
    return min(max(displacement, -limit), limit)


@implements(admissible, SharpCoulombForce)
def _sharp_force_keeps(tangential, normal, overlap, displacement):
    force, _ = normal_response(normal, overlap)
    limit = tangential.friction_coefficient * force
    return min(max(displacement, -limit), limit)


@kernel
def advanced_displacement(interaction, overlap, displacement, slide):
    """What every spring remembers after it has slid by `slide`, (C,); `overlap` at the middle."""
    after = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        after[c] = advanced(
            interaction.tangential,
            interaction.normal,
            max(overlap[c], 0.0),
            displacement[c],
            slide[c],
        )
    return after


@kernel
def stretched(interaction, normal, distance, overlap, displacement, i, j, u):
    """What every spring remembers after a motion u (N, 3) of the grains; (C,).

    ds = t·δr + δℓ, with t and ξ at the middle of the motion.
    """
    after = np.empty(i.shape[0])
    for c in range(i.shape[0]):
        on_i, on_j = u[i[c]], u[j[c]]
        x, y = on_i[0] - on_j[0], on_i[1] - on_j[1]
        mx = normal[c, 0] * distance[c] + 0.5 * x
        my = normal[c, 1] * distance[c] + 0.5 * y
        length = math.hypot(mx, my)
        after[c] = advanced(
            interaction.tangential,
            interaction.normal,
            max(overlap[c] + distance[c] - length, 0.0),
            displacement[c],
            (my * x - mx * y) / length + on_i[2] + on_j[2],
        )
    return after


@kernel
def kept_displacement(interaction, overlap, displacement):
    """What every spring remembers after the law has let it slip; (C,)."""
    kept = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        kept[c] = admissible(
            interaction.tangential, interaction.normal, overlap[c], displacement[c]
        )
    return kept
