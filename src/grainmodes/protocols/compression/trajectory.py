"""Compression from a random placement to a packing in force balance: A, Sec. II and Appendix A.

The grains start at random without overlap at φ = 0.6. Then φ is raised on the grid
φ_k = 0.6 + k Φ: each step shrinks the box affinely, L → L √(φ_k/φ_{k+1}) (A1), (A2), and relaxes
the packing. Positions are stored as fractions of L, so the affine part changes L and nothing else.

A target φ is reached on a branch of its own, which starts from the highest grid point below the
target and relaxes to the final balance. The trajectory itself goes on from the grid. So a packing
depends on (N, seed, φ, protocol) alone, and not on which other φ a study contains.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from grainmodes.kernels.laws import NormalLaw
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.grid import phi_at_step
from grainmodes.relaxation.frictionless import (
    UNJAMMED_FORCE,
    is_unjammed,
    relax_fire,
    relax_fire_large_steps,
    relax_fire_newton,
)
from grainmodes.relaxation.result import RelaxationResult

SIZE_RATIO = 1.4
"""Diameter of the large grains over that of the small ones; half of the grains are large
(A, Sec. II; C, Sec. IV)."""

PHI_ROUNDING = 1e-12
"""Difference of two φ that counts as rounding."""


class CompressionError(ArithmeticError):
    """A compression did not reach its balance within the allowed iterations."""


@dataclass(frozen=True)
class Trajectory:
    """A compression at grid point number `step`.

    `phi_jamming` is the highest grid φ at which the packing was still unjammed, and `iterations`
    the number of all iterations since the random placement.
    """

    packing: Packing
    step: int
    phi_jamming: float
    iterations: int


def place_at_random(n: int, seed: int, normal: NormalLaw, compression: Compression) -> Trajectory:
    """Place N grains at random, without overlap, at the initial φ.

    FIRE pushes uniformly distributed points apart until no two grains touch. Grains are numbered
    along rows of cells, so that neighbours in space are neighbours in memory.

    Args:
        normal: the compiled normal law, such as `Hertz(1.0)`.

    Raises:
        CompressionError: some overlaps remain.
    """
    generator = np.random.default_rng(np.random.SeedSequence([n, seed]))
    points = generator.integers(-(2**63), 2**63, size=(2, n), dtype=np.int64)
    large = compression.large_diameter
    sizes = np.where(np.arange(n) < n // 2, large, large / SIZE_RATIO)
    diameter = generator.permutation(sizes)
    points = points[:, _order_along_rows(points)]
    mass = diameter**2 if compression.masses == "area" else np.ones(n)
    overlapping = Packing(points, diameter, mass, 1.0).at(compression.initial_phi)
    relaxed = relax_fire_large_steps(overlapping, normal, 1e-300, 0.0, compression.max_iterations)
    if relaxed.max_force > 0.0:
        raise CompressionError(
            f"random placement of {n} grains: expected no overlaps, got max|F| = "
            f"{relaxed.max_force:.1e} after {relaxed.iterations} iterations"
        )
    return Trajectory(relaxed.packing, 0, compression.initial_phi, relaxed.iterations)


def _order_along_rows(points: np.ndarray) -> np.ndarray:
    """Order of the points (2, N) along rows of cells about two diameters wide; (N,) int."""
    rows = max(1, math.isqrt(points.shape[1]) // 2)
    x, y = np.floor((points * 2.0**-64 + 0.5) * rows).astype(int)
    return np.lexsort((x, y))


def compress_along_grid(
    start: Trajectory, phi: float, normal: NormalLaw, compression: Compression
) -> Trajectory:
    """Compress to the highest grid point that is not above φ.

    Raises:
        CompressionError: a step did not reach its balance.
    """
    current = start
    while True:
        next_phi = phi_at_step(compression.initial_phi, compression.phi_step, current.step + 1)
        if next_phi > phi + PHI_ROUNDING:
            return current
        current = _compress_one_step(current, next_phi, normal, compression)


def _compress_one_step(
    before: Trajectory, phi: float, normal: NormalLaw, compression: Compression
) -> Trajectory:
    """Compress to the next grid point and relax to the balance of the protocol there."""
    packing, most = before.packing.at(phi), compression.max_iterations
    if compression.relaxation == "fire":
        relaxed = relax_fire(packing, normal, compression.force_tolerance, most)
    else:
        balance = compression.intermediate_balance
        relaxed = relax_fire_large_steps(packing, normal, UNJAMMED_FORCE, balance, most)
    if relaxed.iterations >= most:
        raise CompressionError(
            f"compression to phi = {phi}: expected a balance within {most} iterations, got "
            f"max|F| = {relaxed.max_force:.1e}"
        )
    phi_jamming = phi if is_unjammed(relaxed.packing, normal) else before.phi_jamming
    iterations = before.iterations + relaxed.iterations
    return Trajectory(relaxed.packing, before.step + 1, phi_jamming, iterations)


def compress_to(
    start: Trajectory, phi: float, normal: NormalLaw, compression: Compression
) -> RelaxationResult:
    """The packing at φ in its final balance, max|F| < F_Th, on a branch from the grid.

    Its `iterations` count all iterations since the random placement.

    Raises:
        CompressionError: a step along the grid did not reach its balance.
    """
    grid = compress_along_grid(start, phi, normal, compression)
    relax = relax_fire if compression.relaxation == "fire" else relax_fire_newton
    packing = grid.packing.at(phi)
    final = relax(packing, normal, compression.force_tolerance, compression.max_iterations)
    return replace(final, iterations=grid.iterations + final.iterations)
