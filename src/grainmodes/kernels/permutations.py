"""Parity of permutations, which gives the sign of a determinant."""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.compiler import kernel


@kernel
def is_odd(permutation):
    """1 if a permutation (M,) int is is_odd, else 0: M minus its number of cycles, modulo 2."""
    size = permutation.shape[0]
    seen = np.zeros(size, np.bool_)
    cycles = 0
    for start in range(size):
        cycles += not seen[start]
        at = start
        while not seen[at]:
            seen[at] = True
            at = permutation[at]
    return (size - cycles) % 2
