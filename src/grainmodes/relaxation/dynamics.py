"""Damped dynamics to force balance, and dynamics for a given time: A (1)–(9), Appendix B.

The reference for every frictional relaxation: nothing is assumed but the forces. At small k_T/k_N
the rotations are slow, ω ~ √κ, and millions of steps are needed; Newton's method reaches the same
state (up to the path dependence of s, of second order in the strain).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from grainmodes.kernels.dynamics import Grains, Stop, integrate, transfer_springs
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.neighbours import Neighbours, find_neighbours
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import largest, net_force
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.relaxation.result import Relaxed

SKIN = 0.2
"""Verlet skin in d."""


@dataclass(frozen=True)
class Motion:
    """A packing on the move: velocities of (x, y, ℓ), (N, 3) in d/t_0."""

    packing: Packing
    velocity: np.ndarray
    steps: int
    residual_motion: float


def move(
    packing: Packing,
    velocity: np.ndarray,
    interaction: Interaction,
    damping,
    time_step: float,
    stop: Stop,
) -> Motion:
    """Integrate a frictional packing from `velocity` (N, 3) until `stop`.

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
    damping,
    time_step: float,
    tolerance: float,
    max_steps: int,
) -> Relaxed:
    """From rest until max|F̃| < `tolerance`, judged on the forces without damping.

    The allowed residual motion is lowered until the contact forces are below the tolerance.

    Raises:
        ArithmeticError: as `move`.
    """
    now = Motion(packing, np.zeros((packing.n, 3)), 0, np.inf)
    allowed, steps = tolerance, 0
    while True:
        stop = Stop(allowed, max_steps - steps)
        now = move(now.packing, now.velocity, interaction, damping, time_step, stop)
        steps += now.steps
        force = net_force(now.packing, find_contacts(now.packing), interaction)
        max_force, max_torque = largest(force)
        converged = max(max_force, max_torque) < tolerance
        if converged or steps >= max_steps:
            return Relaxed(now.packing, converged, steps, max_force, max_torque)
        allowed *= 0.25


def _grains(packing: Packing, velocity: np.ndarray) -> Grains:
    x, y = packing.fraction.copy()
    vx, vy, w = np.array(velocity.T, order="C")
    rotation = np.zeros(packing.n) if packing.rotation is None else packing.rotation.copy()
    nothing = np.zeros((3, packing.n))
    return Grains(x, y, vx, vy, w, *nothing, rotation, packing.mass, packing.diameter)


def _springs(packing: Packing, pairs: Neighbours) -> np.ndarray:
    """s of every listed pair from the history; zero elsewhere."""
    history = packing.history
    if history is None:
        return np.zeros(len(pairs.left))
    # The history stores i > j sorted by (i, j); the list wants left < right sorted by left.
    order = np.lexsort((history.i, history.j))
    left, right = history.j[order], history.i[order].astype(np.uint32)
    first = np.searchsorted(left, np.arange(packing.n + 1))
    known = Neighbours(first, left.astype(np.uint32), right, np.zeros(len(left)))
    return transfer_springs(known, history.spring_state[order], pairs)


def _history(pairs: Neighbours, spring: np.ndarray) -> History:
    """The springs that are loaded, as i > j sorted by (i, j)."""
    held = np.flatnonzero(spring)
    i, j = pairs.right[held].astype(np.int32), pairs.left[held].astype(np.int32)
    order = np.lexsort((j, i))
    return History(i[order], j[order], spring[held][order])
