"""Newton's method for force balance: J u = F̃, a handful of sparse solutions.

It converges quadratically near a balance and fails far from one. Therefore every step must lower
max|F̃|; where none does, the iteration stops unconverged and the caller returns to dynamics. The
contacts are found again at every iterate. A frictional step advances the tangential springs
(`kernels.springs`),

    s → s + t·δr + δℓ     t at the middle of the step: error O(δ³)

with s = 0 for a pair at its first touch, so that a path through n iterates is a path of n short
strains.

The packing must have no rattlers: the overlap ξ of a single Hertzian contact falls only to ξ/3 in a
step, and a grain without contacts makes J singular.

| symbol  | name             | shape           | unit        |
| ------- | ---------------- | --------------- | ----------- |
| F̃       | force            | (N, k) float64  | k_N d^(3/2) |
| u       | u                | (N, k) float64  | d           |
| s       | spring_state     | (C,) float64    | d           |
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_springs, clip_springs
from grainmodes.linalg.pinned_factor import FloppyError, PinnedFactor
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import is_frictionless, max_force_and_torque, net_force
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing
from grainmodes.relaxation.backtracking import backtrack
from grainmodes.relaxation.result import RelaxationResult


class _Iterate(NamedTuple):
    """A packing with its net forces F̃ (N, k)."""

    packing: Packing
    force: NDArray[np.float64]


def newton(
    packing: Packing, interaction: Interaction, tolerance: float, max_iterations: int = 8
) -> RelaxationResult:
    """Relax a packing without rattlers until max|F̃| < `tolerance`; at least one step is taken.

    Args:
        tolerance: in k_N d^(3/2), for forces and scaled torques.

    Raises:
        PackingError: two grains lie at the same place.
    """
    now = _Iterate(packing, net_force(packing, interaction))
    iterations = 0
    while iterations < max_iterations:
        iterations += 1
        after = _newton_step(now, interaction)
        if after is None:
            break
        now = after
        if max(max_force_and_torque(now.force)) < tolerance:
            break
    max_force, max_torque = max_force_and_torque(now.force)
    converged = max(max_force, max_torque) < tolerance
    return RelaxationResult(now.packing, converged, iterations, max_force, max_torque)


def _newton_step(now: _Iterate, interaction: Interaction) -> _Iterate | None:
    """The Newton step, shortened until max|F̃| falls; None if it never does."""
    packing, force = now
    matrix = jacobian(packing, interaction)
    try:
        u = PinnedFactor(matrix, symmetric=packing.contacts.spring_state is None).solve(force)
    except FloppyError:
        return None
    u, residual = u.reshape(packing.n, -1), max(max_force_and_torque(force))

    def after(fraction: float) -> _Iterate:
        displaced = displace_with_springs(packing, interaction, fraction * u)
        slipped = apply_slip(displaced, interaction)
        return _Iterate(slipped, net_force(slipped, interaction))

    def improves(trial: _Iterate) -> bool:
        return max(max_force_and_torque(trial.force)) < residual or residual == 0.0

    return backtrack(after, improves)


def displace_with_springs(
    packing: Packing, interaction: Interaction, u: NDArray[np.float64]
) -> Packing:
    """The packing after a small displacement u (N, k) in d, its tangential springs advanced.

    Raises:
        PackingError: u is not finite.
    """
    displaced = packing.displaced(u[:, :2])
    if is_frictionless(interaction):
        return displaced
    rotation = np.zeros(packing.n) if packing.rotation is None else packing.rotation
    c = packing.contacts
    s = advance_springs(interaction, c.normal, c.distance, c.overlap, c.springs, c.i, c.j, u)
    history = History(c.i, c.j, s)
    return replace(displaced, rotation=rotation + u[:, 2], history=history)


def apply_slip(packing: Packing, interaction: Interaction) -> Packing:
    """The packing after each spring has slipped as far as its law requires.

    Raises:
        PackingError: two grains lie at the same place.
    """
    contacts = packing.contacts
    if packing.history is None:
        return packing
    s = clip_springs(interaction, contacts.overlap, contacts.springs)
    return packing.with_springs(s)
