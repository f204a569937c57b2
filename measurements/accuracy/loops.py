"""FIRE and frictional dynamics in a chosen precision, and forces in an extended one.

Positions are integers of 64 bits in any case, so that a difference of two is exact.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
from numba import njit

from grainmodes.kernels.compiler import FLAGS
from grainmodes.kernels.damping import Dashpot
from grainmodes.kernels.dynamics import Grains, Stop, integrate
from grainmodes.kernels.fire import MIXING, FireState, advance, next_state
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.neighbours import FRACTION_UNIT, find_neighbours
from grainmodes.kernels.repulsion import mean_force_and_stiffness
from grainmodes.packing.contacts import History
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.relaxation.frictionless import SKIN, STABILITY_FRACTION
from measurements.accuracy.packings import HERTZ

ROUGH = Interaction.from_law(ContactLaw(kt=1.0))

TIME_STEP, VISCOSITY = 0.01, 1.0
"""Δt / t_0 and η of the dynamics, as in a simulated step strain."""


class Precision(NamedTuple):
    """Types of r and ξ, and of forces and velocities."""

    overlap: type
    force: type

    @property
    def bits(self) -> int:
        """Significant bits of a force."""
        return np.finfo(self.force).nmant + 1


@cache
def descent(overlap: type, force: type) -> Callable:
    """The loop of FIRE at a fixed list of neighbours, compiled for these types."""

    @njit(**{**FLAGS, "cache": False})
    def repulsion(x, y, scale, left, right, contact_distance, force_x, force_y):
        for pair in range(left.shape[0]):
            i, j = left[pair], right[pair]
            dx, dy = overlap(x[i] - x[j]) * scale, overlap(y[i] - y[j]) * scale
            square = dx * dx + dy * dy
            if square < contact_distance[pair] * contact_distance[pair]:
                distance = math.sqrt(square)
                xi = force(contact_distance[pair] - distance)
                pull = xi * math.sqrt(xi)
                fx, fy = pull * force(dx / distance), pull * force(dy / distance)
                force_x[i] += fx
                force_y[i] += fy
                force_x[j] -= fx
                force_y[j] -= fy

    @njit(**{**FLAGS, "cache": False})
    def power_and_norms(vx, vy, fx, fy, inverse_mass, half_step):
        power, speed2, force2 = force(0.0), force(0.0), force(0.0)
        for i in range(vx.shape[0]):
            kick = force(half_step) * inverse_mass[i]
            u, w = vx[i] + kick * fx[i], vy[i] + kick * fy[i]
            power += u * fx[i] + w * fy[i]
            speed2 += u * u + w * w
            force2 += fx[i] * fx[i] + fy[i] * fy[i]
        return power, speed2, force2

    @njit(**{**FLAGS, "cache": False})
    def descend(x, y, inverse_mass, scale, pairs, contact_distance, limit, steps):
        vx, vy, fx, fy = np.zeros((4, x.shape[0]), inverse_mass.dtype)
        left, right = pairs.left, pairs.right
        repulsion(x, y, scale, left, right, contact_distance, fx, fy)
        state = FireState(0.1 * limit, MIXING, 0, 1.0, 0.0, 0.0)
        for _ in range(steps):
            advance(x, y, vx, vy, fx, fy, inverse_mass, state, 1.0 / np.float64(scale), 0.0)
            repulsion(x, y, scale, left, right, contact_distance, fx, fy)
            power, speed2, force2 = power_and_norms(
                vx, vy, fx, fy, inverse_mass, 0.5 * state.time_step
            )
            state = next_state(state, power, speed2, force2, limit)
        return fx, fy

    return descend


def after_fire(packing: Packing, precision: Precision, steps: int) -> tuple[Packing, np.ndarray]:
    """The packing after steps of FIRE, and the forces on it as the loop sees them, (N, 2)."""
    x, y = packing.fraction.copy()
    pairs = find_neighbours(x, y, packing.diameter, packing.box_length, 0.0, SKIN)
    _, stiffness = mean_force_and_stiffness(x, y, packing.box_length, 0.0, pairs, HERTZ)
    limit = STABILITY_FRACTION * 2.0 / math.sqrt(stiffness)
    scale, contact_distance = (
        precision.overlap(packing.box_length * FRACTION_UNIT),
        pairs.contact_distance,
    )
    inverse_mass = np.ones(packing.n, precision.force)
    given = inverse_mass, scale, pairs, contact_distance.astype(precision.overlap), limit, steps
    forces = descent(*precision)(x, y, *given)
    return replace(packing, fraction=np.stack([x, y])), np.stack(forces, axis=1)


def exact_forces(packing: Packing) -> np.ndarray:
    """Hertzian net forces in extended precision, (N, 2)."""
    contacts = packing.contacts
    scale = np.longdouble(packing.box_length) * np.longdouble(FRACTION_UNIT)
    branch = (packing.fraction[:, contacts.i] - packing.fraction[:, contacts.j]) * scale
    distance = np.sqrt((branch**2).sum(axis=0))
    diameter = packing.diameter.astype(np.longdouble)
    overlap = 0.5 * (diameter[contacts.i] + diameter[contacts.j]) - distance
    forces = overlap**1.5 * branch / distance
    total = np.zeros((packing.n, 2), np.longdouble)
    np.add.at(total, contacts.i, forces.T)
    np.add.at(total, contacts.j, -forces.T)
    return total


def after_dynamics(packing: Packing, force: type, steps: int) -> Packing:
    """The packing after steps of damped dynamics from rest, its state kept in this type."""
    x, y = packing.fraction.copy()
    state, mass = np.zeros((7, packing.n), force), packing.mass.astype(force)
    grains = Grains(x, y, *state, mass, packing.diameter)
    pairs = find_neighbours(x, y, packing.diameter, packing.box_length, packing.strain, SKIN)
    given = ROUGH, Dashpot(VISCOSITY), TIME_STEP, SKIN, Stop(0.0, steps)
    spring = np.zeros(len(pairs.left))
    pairs, spring, *_ = integrate(grains, packing.box_length, packing.strain, pairs, spring, *given)
    history = History.from_pairs(pairs.right.astype(np.int32), pairs.left.astype(np.int32), spring)
    return replace(packing, fraction=np.stack([x, y]), history=history)
