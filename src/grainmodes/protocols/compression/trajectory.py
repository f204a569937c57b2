"""Compression from random placement to a packing in force balance: A, Sec. II and Appendix A.

Grains at random without overlap at φ = 0.6; φ is raised on the grid φ_k = 0.6 + k Φ by shrinking
the box affinely, L → L √(φ_k/φ_{k+1}) (A1), (A2), and the packing is relaxed after each step. With
positions stored as fractions of L, a step changes L and nothing else.

A target is reached from the highest grid point below it on a branch of its own, with its final
balance; the trajectory itself goes on from the grid. So a packing depends on (N, seed, φ, protocol)
alone, not on which other φ a study asks for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.grid import phi_at_step
from grainmodes.relaxation.frictionless import (
    FLOPPY_FORCE,
    relax_fast,
    relax_fire,
    relax_loosely,
    unjammed,
)
from grainmodes.relaxation.result import Relaxed

SIZE_RATIO = 1.4
"""Large diameter over small, half of the grains each (A, Sec. II; C, Sec. IV)."""


class CompressionError(ArithmeticError):
    """A compression that did not reach balance within the allowed iterations."""


@dataclass(frozen=True)
class Trajectory:
    """Where a compression stands: on grid point `step`, last unjammed at `phi_jamming`."""

    packing: Packing
    step: int
    phi_jamming: float
    iterations: int


def placed(n: int, seed: int, normal, protocol: Compression) -> Trajectory:
    """N grains at random, without overlap, at the initial φ.

    Uniform points are pushed apart by FIRE until nothing touches. Grains are numbered along rows of
    cells, so that neighbours in space are neighbours in memory.

    Raises:
        CompressionError: overlaps remain.
    """
    generator = np.random.default_rng(np.random.SeedSequence([n, seed]))
    points = generator.integers(-(2**63), 2**63, size=(2, n), dtype=np.int64)
    large = protocol.large_diameter
    sizes = np.where(np.arange(n) < n // 2, large, large / SIZE_RATIO)
    diameter = generator.permutation(sizes)
    points = points[:, _rows_of_cells(points)]
    mass = diameter**2 if protocol.masses == "area" else np.ones(n)
    loose = Packing(points, diameter, mass, 1.0).at(protocol.initial_phi)
    relaxed = relax_loosely(loose, normal, 1e-300, 0.0, protocol.max_iterations)
    if relaxed.max_force > 0.0:
        raise CompressionError(f"random placement of {n} grains kept overlaps")
    return Trajectory(relaxed.packing, 0, protocol.initial_phi, relaxed.iterations)


def _rows_of_cells(points: np.ndarray) -> np.ndarray:
    """Order of the grains along rows of cells about two diameters wide."""
    rows = max(1, math.isqrt(points.shape[1]) // 2)
    x, y = np.floor((points * 2.0**-64 + 0.5) * rows).astype(int)
    return np.lexsort((x, y))


def advanced(start: Trajectory, phi: float, normal, protocol: Compression) -> Trajectory:
    """The trajectory at the highest grid point not above φ.

    Raises:
        CompressionError: a step did not reach its balance.
    """
    now = start
    while phi_at_step(protocol.initial_phi, protocol.phi_step, now.step + 1) <= phi + 1e-12:
        now = _next(now, normal, protocol)
    return now


def _next(now: Trajectory, normal, protocol: Compression) -> Trajectory:
    """One step Φ, relaxed."""
    phi = phi_at_step(protocol.initial_phi, protocol.phi_step, now.step + 1)
    relaxed = _relaxed_step(now.packing.at(phi), normal, protocol)
    if relaxed.iterations >= protocol.max_iterations:
        raise CompressionError(
            f"phi = {phi}: max|F| = {relaxed.max_force:.1e} after {relaxed.iterations} iterations"
        )
    floppy = unjammed(relaxed.packing, normal)
    return Trajectory(
        relaxed.packing,
        now.step + 1,
        phi if floppy else now.phi_jamming,
        now.iterations + relaxed.iterations,
    )


def _relaxed_step(packing: Packing, normal, protocol: Compression) -> Relaxed:
    """The balance that the protocol asks for between two steps."""
    if protocol.relaxation == "fire":
        return relax_fire(packing, normal, protocol.force_tolerance, protocol.max_iterations)
    return relax_loosely(
        packing, normal, FLOPPY_FORCE, protocol.intermediate_balance, protocol.max_iterations
    )


def balanced(start: Trajectory, phi: float, normal, protocol: Compression) -> Relaxed:
    """The packing at φ, on a branch from the grid, in its final balance max|F| < F_Th.

    `iterations` counts everything since the random placement.
    """
    grid = advanced(start, phi, normal, protocol)
    relax = relax_fire if protocol.relaxation == "fire" else relax_fast
    final = relax(grid.packing.at(phi), normal, protocol.force_tolerance, protocol.max_iterations)
    return replace(final, iterations=grid.iterations + final.iterations)
