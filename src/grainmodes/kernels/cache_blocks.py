"""Blocks of grains whose pair forces fit the first-level cache.

The first of two passes over a block computes the force of every pair, the second adds them to the
grains.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.compiler import kernel

GRAINS_PER_BLOCK = 256
"""Grains per block: about 800 pairs, 13 kB of pair forces."""


@kernel
def pair_scratch(neighbours, components):
    """An array for the pair forces of the largest block, (components, P_max) float64."""
    first = neighbours.first
    n = first.shape[0] - 1
    widest = 0
    for begin in range(0, n, GRAINS_PER_BLOCK):
        widest = max(widest, first[min(begin + GRAINS_PER_BLOCK, n)] - first[begin])
    return np.empty((components, widest))
