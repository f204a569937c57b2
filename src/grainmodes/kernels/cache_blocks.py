"""Blocks of grains whose pair forces fit the first-level cache.

The first of two passes over a block computes the force of every pair, the second adds them to the
grains.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.compiler import kernel

BLOCK = 256
"""Grains per block: about 800 pairs, 13 kB of pair forces."""


@kernel
def pair_scratch(neighbours, components):
    """Room for the pair forces of the fullest block; shape (components, P_max)."""
    first = neighbours.first
    n = first.shape[0] - 1
    widest = 0
    for begin in range(0, n, BLOCK):
        widest = max(widest, first[min(begin + BLOCK, n)] - first[begin])
    return np.empty((components, widest))
