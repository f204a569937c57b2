"""How accurate one step of the damped dynamics is: A, Appendix B 1.

A step of Δt from a state in motion is compared with 32 steps of Δt/32. Its error is of order
Δt^(p+1), where p is the order up to which the step is right. Where the forces depend on the
velocity, A finds p = 2 in q and p = 1 in q̇. Over a given time these errors add up to order 1 in
both.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.neighbours import FRACTION_UNIT
from grainmodes.packing.state import Packing
from grainmodes.relaxation.dynamics import Damping, Motion, move

TIME_STEP = 1e-3
"""Longest Δt, in t_0: a tenth of A's, so that the next order does not show."""

REFERENCE_STEPS = 32
"""Number of steps of the reference within Δt."""

AMPLITUDE = 1e-6
"""Size of the displacements and velocities at the start, d and d/t_0: no contact opens."""


class Orders(NamedTuple):
    """Orders p of a step in q and in q̇."""

    position: float
    velocity: float


def step_orders(packing: Packing, interaction: Interaction, damping: Damping) -> Orders:
    """The orders p of velocity Verlet on a frictional packing, from steps of Δt and Δt/4.

    Raises:
        ArithmeticError: the motion grew beyond all bounds.
    """
    kick = AMPLITUDE * np.random.default_rng(0).standard_normal((2, packing.n, 3))
    start = replace(packing.displaced(kick[0, :, :2]), rotation=kick[0, :, 2])
    coarse, fine = (
        _errors(start, kick[1], interaction, damping, time_step)
        for time_step in (TIME_STEP, TIME_STEP / 4.0)
    )
    return Orders(*(np.log2(coarse / fine) / 2.0 - 1.0).tolist())


def _errors(
    start: Packing,
    velocity: NDArray[np.float64],
    interaction: Interaction,
    damping: Damping,
    time_step: float,
) -> NDArray[np.float64]:
    """Errors (2,) of q and q̇ after one step, root of the sum of squares."""
    once, often = (
        move(start, velocity, interaction, damping, time_step / steps, Stop(0.0, steps))
        for steps in (1, REFERENCE_STEPS)
    )
    return np.array([_distance(once, often), np.linalg.norm(once.velocity - often.velocity)])


def _distance(one: Motion, other: Motion) -> float:
    """|q − q'| of two motions of a packing in a box that is not sheared."""
    step = (one.packing.fraction - other.packing.fraction) * FRACTION_UNIT * one.packing.box_length
    # Every motion has rotations: `move` sets them.
    assert one.packing.rotation is not None and other.packing.rotation is not None
    turn = one.packing.rotation - other.packing.rotation
    return float(np.sqrt(np.sum(step**2) + np.sum(turn**2)))
