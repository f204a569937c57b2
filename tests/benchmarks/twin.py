"""Frictionless Hertz forces written by hand: no law, no shear, no type to be specialised for.

    F_i = Σ_j ξ^(3/2) n_ij                                                 A (A4)

What `grainmodes.kernels.repulsion` is measured against. The loops are the same two passes over
blocks of 256 grains, as fast as they could be made; `plain` is the loop that one writes first.
"""

from __future__ import annotations

import math

import numba
import numpy as np

FLAGS = {"error_model": "numpy", "fastmath": {"reassoc", "contract", "nsz"}}
BLOCK = 256


@numba.njit(**FLAGS)
def by_hand(x, y, scale, first, left, right, reach, scratch, fx, fy):
    """Add the net forces to fx and fy (N,); x, y (N,) int64 in 2⁻⁶⁴ L, scale = 2⁻⁶⁴ L."""
    n = x.shape[0]
    for begin in range(0, n, BLOCK):
        end = min(begin + BLOCK, n)
        _pairs(x, y, scale, left, right, reach, first[begin], first[end], scratch)
        _sums(first, right, begin, end, scratch, fx, fy)


@numba.njit(**FLAGS)
def _pairs(x, y, scale, left, right, reach, low, high, scratch):
    for k in range(high - low):
        i, j = left[low + k], right[low + k]
        dx = np.float64(x[i] - x[j]) * scale
        dy = np.float64(y[i] - y[j]) * scale
        r = math.sqrt(dx * dx + dy * dy)
        xi = max(reach[low + k] - r, 0.0)
        f = xi * math.sqrt(xi) / r
        scratch[0, k] = f * dx
        scratch[1, k] = f * dy


@numba.njit(**FLAGS)
def _sums(first, right, begin, end, scratch, fx, fy):
    base = first[begin]
    for i in range(begin, end):
        sum_x, sum_y = 0.0, 0.0
        for pair in range(first[i], first[i + 1]):
            j = right[pair]
            sum_x += scratch[0, pair - base]
            sum_y += scratch[1, pair - base]
            fx[j] -= scratch[0, pair - base]
            fy[j] -= scratch[1, pair - base]
        fx[i] += sum_x
        fy[i] += sum_y


@numba.njit(**FLAGS)
def plain(x, y, scale, first, left, right, reach, scratch, fx, fy):
    """The same by one loop over the pairs."""
    for pair in range(left.shape[0]):
        i, j = left[pair], right[pair]
        dx = np.float64(x[i] - x[j]) * scale
        dy = np.float64(y[i] - y[j]) * scale
        square = dx * dx + dy * dy
        if square < reach[pair] ** 2:
            r = math.sqrt(square)
            xi = reach[pair] - r
            f = xi * math.sqrt(xi) / r
            fx[i] += f * dx
            fy[i] += f * dy
            fx[j] -= f * dx
            fy[j] -= f * dy
