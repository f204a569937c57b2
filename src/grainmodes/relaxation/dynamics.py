"""Damped dynamics to force balance, and dynamics for a given time: A (1)–(9), Appendix B.

This is the reference for every frictional relaxation: nothing is assumed but the forces. At small
κ = k_T/k_N the rotations are slow, ω ~ √κ, and millions of steps are needed. Newton's method
reaches the same state, up to the path dependence of s, which is of second order in the strain.

| symbol      | name        | shape, type         | unit                      |
| ----------- | ----------- | ------------------- | ------------------------- |
| q̇           | velocity    | (N, 3) float64      | d/t_0, of (x, y, ℓ)       |
| Δt          | time_step   | float               | t_0                       |
| s           | spring      | (pairs,) float64    | as the law stores it      |
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from grainmodes.kernels.damping import Dashpot, Drag, TranslationalDrag, Undamped
from grainmodes.kernels.dynamics import Grains, Stop, integrate, transfer_springs
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.neighbours import Neighbours, find_neighbours
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.packing.state import Packing
from grainmodes.relaxation.frictionless import SKIN
from grainmodes.relaxation.result import RelaxationResult

Damping = Dashpot | Drag | TranslationalDrag | Undamped


@dataclass(frozen=True)
class Motion:
    """A packing in motion.

    `velocity` is that of (x, y, ℓ), (N, 3) in d/t_0; `steps` were taken to get here;
    `residual_motion` is what remains of it (`kernels.dynamics.residual_motion`).
    """

    packing: Packing
    velocity: NDArray[np.float64]
    steps: int
    residual_motion: float


def move(
    packing: Packing,
    velocity: NDArray[np.float64],
    interaction: Interaction,
    damping: Damping,
    time_step: float,
    stop: Stop,
) -> Motion:
    """Integrate the motion of a frictional packing: A (1)–(9).

    Args:
        velocity: (N, 3) of (x, y, ℓ) at the start, in d/t_0.
        time_step: Δt in t_0.
        stop: when to stop.

    Raises:
        ArithmeticError: the motion grew beyond all bounds: the time step is too long.
    """
    grains = _grains(packing, velocity)
    pairs = find_neighbours(
        grains.x, grains.y, packing.diameter, packing.box_length, packing.strain, SKIN
    )
    pairs, spring, steps, residual_motion = integrate(
        grains,
        packing.box_length,
        packing.strain,
        pairs,
        _springs(packing, pairs),
        interaction,
        damping,
        time_step,
        SKIN,
        stop,
    )
    if steps and not residual_motion < np.inf:
        raise ArithmeticError(
            f"the motion grew beyond all bounds within {steps} steps of time_step = {time_step}: "
            "take a shorter one"
        )
    moved = replace(
        packing,
        fraction=np.stack([grains.x, grains.y]),
        rotation=grains.rotation,
        history=_history(pairs, spring),
    )
    return Motion(moved, np.stack([grains.vx, grains.vy, grains.w], axis=1), steps, residual_motion)


def relax_damped(
    packing: Packing,
    interaction: Interaction,
    damping: Damping,
    time_step: float,
    tolerance: float,
    max_steps: int,
) -> RelaxationResult:
    """Relax from rest until max|F̃| < `tolerance`, where F̃ is without the damping forces.

    The allowed residual motion is lowered until the contact forces are below the tolerance.

    Args:
        time_step: Δt in t_0.
        tolerance: in k_N d^(3/2), for forces and scaled torques.

    Raises:
        ArithmeticError: as `move`.
    """
    now = Motion(packing, np.zeros((packing.n, 3)), 0, np.inf)
    allowed_motion, steps = tolerance, 0
    while True:
        stop = Stop(allowed_motion, max_steps - steps)
        now = move(now.packing, now.velocity, interaction, damping, time_step, stop)
        steps += now.steps
        force = net_force(now.packing, interaction)
        max_force, max_torque = max_force_and_torque(force)
        converged = max(max_force, max_torque) < tolerance
        if converged or steps >= max_steps:
            return RelaxationResult(now.packing, converged, steps, max_force, max_torque)
        allowed_motion *= 0.25


def _grains(packing: Packing, velocity: NDArray[np.float64]) -> Grains:
    x, y = packing.fraction.copy()
    vx, vy, w = np.array(velocity.T, order="C")
    rotation = np.zeros(packing.n) if packing.rotation is None else packing.rotation.copy()
    fx, fy, torque = np.zeros((3, packing.n))
    return Grains(x, y, vx, vy, w, fx, fy, torque, rotation, packing.mass, packing.diameter)


def _springs(packing: Packing, pairs: Neighbours) -> NDArray[np.float64]:
    """s of every pair in the neighbour list: from the history, or zero."""
    history = packing.history
    if history is None:
        return np.zeros(len(pairs.left))
    # The history stores i > j sorted by (i, j); the list needs left < right sorted by left.
    order = np.lexsort((history.i, history.j))
    left, right = history.j[order], history.i[order].astype(np.uint32)
    first = np.searchsorted(left, np.arange(packing.n + 1))
    known = Neighbours(first, left.astype(np.uint32), right, np.zeros(len(left)))
    return transfer_springs(known, history.spring_state[order], pairs)


def _history(pairs: Neighbours, spring: NDArray[np.float64]) -> History:
    """The springs with s ≠ 0, as pairs i > j sorted by (i, j)."""
    loaded = np.flatnonzero(spring)
    i, j = pairs.right[loaded].astype(np.int32), pairs.left[loaded].astype(np.int32)
    order = np.lexsort((j, i))
    return History(i[order], j[order], spring[loaded][order])
