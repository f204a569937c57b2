"""What tangential springs remember: how it advances with ds, and how much the law lets it keep.

| remembered           | advances by                                | keeps                        |
| -------------------- | ------------------------------------------ | ---------------------------- |
| s  displacement      | ds                                         | all; sharp Coulomb: |s| ≤ s* |
| h  force             | k_T w(ξ) ds, ξ at the middle of the step   | all; sharp Coulomb: μ f_N    |

A displacement feels every later change of the overlap, f_T = −k_T w(ξ) s; a force does not, and so
∂f_T/∂ξ = 0. LAMMPS calls the two `mindlin` and `mindlin/force`. Which is which, each law says
(`laws`).
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.laws import admissible, advanced, threshold


@kernel
def thresholds(interaction, overlap):
    """What every spring remembers where its contact begins to slide, (C,); ∞ if it never does."""
    found = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        found[c] = threshold(interaction.tangential, interaction.normal, overlap[c])
    return found


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
