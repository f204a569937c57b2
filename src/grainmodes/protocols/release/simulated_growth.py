"""The growth rate of a balance that is released along its fastest mode: C, Sec. VI A.

    q(t) = q + a Re(u e^(iωt)),   iω = ω_i − iω_r       the growing solution of C (13), alone

so that the kinetic energy, averaged over a period 2π/ω_r, grows as e^(2ω_i t) from the start, where
linear theory is right. For a sharp Coulomb law u is a mode of the J of slipping springs, and the
Newtonian dynamics, which knows both sides of the threshold, decides.
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.damping import Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing
from grainmodes.protocols.shear.coulomb_threshold import SLIPPING, FastestPair, fastest_mode
from grainmodes.relaxation.dynamics import Motion, move
from grainmodes.relaxation.newton import apply_slip, displace_with_springs

AMPLITUDE = 1e-11
"""a in d: 1e3 times what a balance of max|F̃| = 1e-14 leaves over in other modes."""

E_FOLDS = 12.0
"""ω_i t at the end: a grows to 2e-6 d, before most contacts open or close."""

TIME_STEP_RATIO = 0.1
"""Time step in units of 1/ω_max: ω is then wrong by (ω Δt)²/24, 4e-4 at most."""

SAMPLES_PER_PERIOD = 16
"""Number of times in a period at which the kinetic energy is taken."""

MAX_STEPS = 200_000
"""Time steps after which a slow growth is judged by what it has reached."""


def simulated_growth_rate(packing: Packing, interaction: Interaction, pair: FastestPair) -> float:
    """The rate at which a released balance is left, in 1/t_0; ω_i where linear theory is right.

    Raises:
        ArithmeticError: the motion grew beyond all bounds.
    """
    period = 2.0 * math.pi / pair.frequency
    samples = math.ceil(period * pair.highest_frequency / (TIME_STEP_RATIO * SAMPLES_PER_PERIOD))
    steps = SAMPLES_PER_PERIOD * samples
    periods = math.ceil(E_FOLDS / (pair.growth_rate * period))
    periods = min(periods, MAX_STEPS // steps)
    time_step = period / steps
    motion = _on_growing_solution(packing, interaction, pair)
    first, motion = _period(motion, interaction, time_step, steps)
    motion = _move_freely(motion, interaction, time_step, (periods - 1) * steps)
    last, _ = _period(motion, interaction, time_step, steps)
    return math.log(last / first) / (2.0 * periods * period)


def _on_growing_solution(packing: Packing, interaction: Interaction, pair: FastestPair) -> Motion:
    """The state q + a Re(u), its springs at most at their threshold, and its velocity."""
    u = AMPLITUDE * fastest_mode(packing, interaction, SLIPPING)
    velocity = (-1j * np.sqrt(complex(pair.eigenvalue)) * u).real
    start = apply_slip(displace_with_springs(packing, interaction, u.real), interaction)
    return Motion(start, velocity, 0, math.inf)


def _period(
    motion: Motion, interaction: Interaction, time_step: float, steps: int
) -> tuple[float, Motion]:
    """The kinetic energy averaged over a period, and the motion after it."""
    mass, energy = generalized_mass(motion.packing.mass), 0.0
    for _ in range(SAMPLES_PER_PERIOD):
        motion = _move_freely(motion, interaction, time_step, steps // SAMPLES_PER_PERIOD)
        energy += 0.5 * float(np.sum(mass * motion.velocity**2)) / SAMPLES_PER_PERIOD
    return energy, motion


def _move_freely(motion: Motion, interaction: Interaction, time_step: float, steps: int) -> Motion:
    stop = Stop(0.0, steps)
    return move(motion.packing, motion.velocity, interaction, Undamped(), time_step, stop)
