"""The states of tangential springs: how they advance with a slide, and where the law clips them.

| spring state          | advances by                              | clipped by sharp Coulomb to |
| --------------------- | ---------------------------------------- | --------------------------- |
| s  displacement, d    | ds                                       | |s| ≤ s*                    |
| h  force, k_N d^(3/2) | k_T w(ξ) ds, ξ at the middle of the step | |h| ≤ μ f_N                 |

The force of a spring that remembers a displacement changes with the overlap, f_T = −k_T w(ξ) s. A
remembered force does not, and so ∂f_T/∂ξ = 0. LAMMPS calls the two `mindlin` and `mindlin/force`.
Each law (`laws`) states which of them it uses.

C contacts between grains i, j (C,) int32; overlap, distance and spring_state are (C,) float64.
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.laws import advance_spring, clip_to_coulomb, slip_threshold


@kernel
def slip_thresholds(interaction, overlap):
    """Size of the spring state from which every contact slides, (C,); ∞ if it never does."""
    at_slip = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        at_slip[c] = slip_threshold(interaction.tangential, interaction.normal, overlap[c])
    return at_slip


@kernel
def advance_by_slide(interaction, overlap, spring_state, slide):
    """Spring states after slides ds (C,) in d, with `overlap` at the middle of the step; (C,)."""
    after = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        after[c] = advance_spring(
            interaction.tangential,
            interaction.normal,
            max(overlap[c], 0.0),
            spring_state[c],
            slide[c],
        )
    return after


@kernel
def advance_springs(interaction, normal, distance, overlap, spring_state, i, j, u):
    """Spring states after a motion u (N, 3) of the grains, (x, y, ℓ) in d; (C,).

    ds = t·δr + δℓ, with t and ξ at the middle of the motion.
    """
    after = np.empty(i.shape[0])
    for c in range(i.shape[0]):
        on_i, on_j = u[i[c]], u[j[c]]
        x, y = on_i[0] - on_j[0], on_i[1] - on_j[1]
        mx = normal[c, 0] * distance[c] + 0.5 * x
        my = normal[c, 1] * distance[c] + 0.5 * y
        length = math.sqrt(mx * mx + my * my)
        after[c] = advance_spring(
            interaction.tangential,
            interaction.normal,
            max(overlap[c] + distance[c] - length, 0.0),
            spring_state[c],
            (my * x - mx * y) / length + on_i[2] + on_j[2],
        )
    return after


@kernel
def clip_springs(interaction, overlap, spring_state):
    """Spring states after slip, (C,)."""
    clipped = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        clipped[c] = clip_to_coulomb(
            interaction.tangential, interaction.normal, overlap[c], spring_state[c]
        )
    return clipped
