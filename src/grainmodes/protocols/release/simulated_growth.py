"""A balance released along an oscillation that linear theory says grows: C, Sec. VI A.

    q(t) = q + a Re(u e^(iωt)),   iω = ω_i − iω_r       the growing solution of C (13), alone

so that the kinetic energy, averaged over a period 2π/ω_r, grows as e^(2ω_i t) from the start, where
linear theory is right. Of a sharp Coulomb law u belongs to the J of slipping springs, and the
Newtonian dynamics, which knows both sides, decides.
"""

from __future__ import annotations

import math

import numpy as np

from grainmodes.kernels.damping import Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.protocols.shear.one_sided import SLIPPING, Oscillation, growing_mode
from grainmodes.relaxation.dynamics import Motion, move
from grainmodes.relaxation.newton import moved_by, slipped

SIZE = 1e-11
"""a in d: 1e3 times what a balance of max|F̃| = 1e-14 leaves over in other modes."""

E_FOLDS = 12.0
"""ω_i t at the end: a grows to 2e-6 d, before most contacts open or close."""

SHORT = 0.1
"""Time step in units of 1/ω_max: ω is then wrong by (ω Δt)²/24, 4e-4 at most."""

LOOKS = 16
"""Times a period at which the kinetic energy is looked at."""

MOST_STEPS = 200_000
"""Time steps after which a slow growth is judged by what it reached."""


def growth_rate(packing: Packing, interaction: Interaction, found: Oscillation) -> float:
    """The rate at which a released balance leaves, in 1/t_0; ω_i where linear theory is right."""
    period = 2.0 * math.pi / found.frequency
    steps = LOOKS * math.ceil(period * found.stiffest / (SHORT * LOOKS))
    periods = math.ceil(E_FOLDS / (found.rate * period))
    periods = min(periods, MOST_STEPS // steps)
    time_step = period / steps
    first, motion = _period(_released(packing, interaction, found), interaction, time_step, steps)
    motion = _moved(motion, interaction, time_step, (periods - 1) * steps)
    last, _ = _period(motion, interaction, time_step, steps)
    return math.log(last / first) / (2.0 * periods * period)


def _released(packing: Packing, interaction: Interaction, found: Oscillation) -> Motion:
    """On the growing solution, its phase that of u."""
    contacts = find_contacts(packing)
    u = SIZE * growing_mode(packing, contacts, interaction, SLIPPING)
    velocity = (-1j * np.sqrt(complex(found.eigenvalue)) * u).real
    start, _ = slipped(moved_by(packing, contacts, interaction, u.real), interaction)
    return Motion(start, velocity, 0, math.inf)


def _period(
    motion: Motion, interaction: Interaction, time_step: float, steps: int
) -> tuple[float, Motion]:
    """The kinetic energy averaged over a period, and the motion after it."""
    mass, energy = generalized_mass(motion.packing.mass), 0.0
    for _ in range(LOOKS):
        motion = _moved(motion, interaction, time_step, steps // LOOKS)
        energy += 0.5 * float(np.sum(mass * motion.velocity**2)) / LOOKS
    return energy, motion


def _moved(motion: Motion, interaction: Interaction, time_step: float, steps: int) -> Motion:
    stop = Stop(0.0, steps)
    return move(motion.packing, motion.velocity, interaction, Undamped(), time_step, stop)
