"""Frictionless Hertz forces written by hand: no law, no shear, no type to be specialised for.

    F_i = Σ_j ξ^(3/2) n_ij                                                 A (A4)

`grainmodes.kernels.repulsion` is compared with them on the same positions and the same list of
pairs. They use all that is known beforehand: k_N = 1, γ = 0, one root for ξ^(3/2)/r.
`one_loop` and `row_by_row` branch at every pair, `in_blocks` nowhere: it vectorises.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numba
import numpy as np

from grainmodes.kernels.laws import Hertz
from grainmodes.kernels.neighbours import FRACTION_UNIT, find_neighbours
from grainmodes.kernels.repulsion import repulsion
from grainmodes.relaxation.frictionless import SKIN

FLAGS = {"error_model": "numpy"}
GRAINS_PER_BLOCK = 256
ROUNDS = 41
"""Times that the project's kernel and its twins are run in turn."""


@numba.njit(**FLAGS)
def one_loop(x, y, scale, pairs, fx, fy):
    """Add the net forces to fx and fy (N,); x, y (N,) int64 in 2⁻⁶⁴ L, scale = 2⁻⁶⁴ L."""
    left, right, contact_distance = pairs.left, pairs.right, pairs.contact_distance
    for pair in range(left.shape[0]):
        i, j = left[pair], right[pair]
        dx = np.float64(x[i] - x[j]) * scale
        dy = np.float64(y[i] - y[j]) * scale
        square = dx * dx + dy * dy
        if square < contact_distance[pair] * contact_distance[pair]:
            xi = contact_distance[pair] - math.sqrt(square)
            f = math.sqrt(xi * xi * xi / square)
            fx[i] += f * dx
            fy[i] += f * dy
            fx[j] -= f * dx
            fy[j] -= f * dy


@numba.njit(**FLAGS)
def row_by_row(x, y, scale, pairs, fx, fy):
    """The same, the force on the grain of a row kept in registers."""
    for i in range(x.shape[0]):
        sum_x, sum_y = 0.0, 0.0
        for pair in range(pairs.first[i], pairs.first[i + 1]):
            j = pairs.right[pair]
            dx = np.float64(x[i] - x[j]) * scale
            dy = np.float64(y[i] - y[j]) * scale
            square = dx * dx + dy * dy
            if square < pairs.contact_distance[pair] * pairs.contact_distance[pair]:
                xi = pairs.contact_distance[pair] - math.sqrt(square)
                f = math.sqrt(xi * xi * xi / square)
                sum_x += f * dx
                sum_y += f * dy
                fx[j] -= f * dx
                fy[j] -= f * dy
        fx[i] += sum_x
        fy[i] += sum_y


@numba.njit(**FLAGS)
def in_blocks(x, y, scale, pairs, fx, fy):
    """The same without a branch, in blocks of grains that fit the first-level cache."""
    n = x.shape[0]
    forces = np.empty((2, 16 * GRAINS_PER_BLOCK))
    for begin in range(0, n, GRAINS_PER_BLOCK):
        end = min(begin + GRAINS_PER_BLOCK, n)
        _pairs(x, y, scale, pairs, pairs.first[begin], pairs.first[end], forces)
        _sums(pairs, begin, end, forces, fx, fy)


@numba.njit(**FLAGS)
def _pairs(x, y, scale, pairs, low, high, forces):
    left, right, contact_distance = pairs.left, pairs.right, pairs.contact_distance
    for k in range(high - low):
        i, j = left[low + k], right[low + k]
        dx = np.float64(x[i] - x[j]) * scale
        dy = np.float64(y[i] - y[j]) * scale
        r = math.sqrt(dx * dx + dy * dy)
        xi = max(contact_distance[low + k] - r, 0.0)
        f = xi * math.sqrt(xi) / r
        forces[0, k] = f * dx
        forces[1, k] = f * dy


@numba.njit(**FLAGS)
def _sums(pairs, begin, end, forces, fx, fy):
    first, right = pairs.first, pairs.right
    base = first[begin]
    for i in range(begin, end):
        sum_x, sum_y = 0.0, 0.0
        for pair in range(first[i], first[i + 1]):
            j, px, py = right[pair], forces[0, pair - base], forces[1, pair - base]
            sum_x += px
            sum_y += py
            fx[j] -= px
            fy[j] -= py
        fx[i] += sum_x
        fy[i] += sum_y


@numba.njit(**FLAGS)
def project(x, y, box_length, pairs, fx, fy, times):
    """The project's forces so many times, called as FIRE calls them, from compiled code."""
    for _ in range(times):
        repulsion(x, y, box_length, 0.0, pairs, Hertz(1.0), fx, fy)


def by_hand(kernel) -> Callable:
    """One of the kernels above, called like `project`."""

    @numba.njit(**FLAGS)
    def repeated(x, y, box_length, pairs, fx, fy, times):
        for _ in range(times):
            kernel(x, y, box_length * FRACTION_UNIT, pairs, fx, fy)

    return repeated


def forces_in_twins(n: int) -> float:
    """CPU time of the project's frictionless forces in that of the fastest twin; median."""
    from measurements.benchmarks.cases import quenched

    packing, times = quenched(n, 0.9, 1e-5), max(2, 500_000 // n)
    x, y = packing.fraction
    pairs = find_neighbours(x, y, packing.diameter, packing.box_length, 0.0, SKIN)
    kernels = [project, *map(by_hand, (one_loop, row_by_row, in_blocks))]
    given = x, y, packing.box_length, pairs
    agree(kernels, given)
    took = np.array([[_seconds(each, given, times) for each in kernels] for _ in range(ROUNDS)])
    return float(np.median(took[:, :1] / took[:, 1:], axis=0).max())


def agree(kernels: list[Callable], given: tuple) -> None:
    """Compile the kernels and compare their forces.

    Raises:
        AssertionError: they differ.
    """
    forces = [np.zeros((2, len(given[0]))) for _ in kernels]
    for kernel, force in zip(kernels, forces, strict=True):
        kernel(*given, *force, 1)
        np.testing.assert_allclose(force, forces[0], atol=1e-13)


def _seconds(kernel: Callable, given: tuple, times: int) -> float:
    force = np.zeros((2, len(given[0])))
    start = time.process_time()
    kernel(*given, *force, times)
    return time.process_time() - start
