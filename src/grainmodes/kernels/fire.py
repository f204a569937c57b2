"""FIRE: the fast inertial relaxation engine of A, Appendix A, (i)–(iv).

    v → v + Δt F/2m,   r → r + Δt v,   v → v + Δt F̃/2m               (A5), (A6)
    v → (1 − χ) v + χ |v| F̂                                          (A7), sign of F mended
    P = F·v > 0 for N_min steps:  Δt → min(1.1 Δt, Δt_max), χ → 0.99 χ  (A8), (A9)
    P ≤ 0:  v → 0, χ → 0.1, Δt → Δt/2                                (A10)–(A12)

As printed, (A7) adds χ (v̂ − F)|v|, which steers away from the force; the rule above is that of the
method A cites. The second half kick, the mixing (A7) and the next first half kick are one linear
combination of v and F, so a step writes each grain once and reads every pair once.

| symbol       | name          |        | symbol | name     |
| ------------ | ------------- | ------ | ------ | -------- |
| Δt_F         | time_step     |        | χ      | mixing   |
| Δt_F,max     | limit         |        | P      | power    |
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.neighbours import RESOLUTION, find_neighbours
from grainmodes.kernels.repulsion import load, repulsion

INCREASE, DECREASE, MIXING, MIXING_DECAY, PATIENCE = 1.1, 0.5, 0.1, 0.99, 5
"""f_inc, f_dec, χ_start, f_χ and N_min of paper A."""

REVIEW = 50
"""Steps between two looks at the contact stiffness and the mean contact force."""


class FireSettings(NamedTuple):
    """When to stop, and the largest time step.

    Stops at max|F| < max(force_tolerance, balance · mean contact force). The time step is at most
    `largest_time_step` and at most `stability` times the limit 2/√λ_max of the harmonic oscillator.
    """

    force_tolerance: float
    balance: float
    largest_time_step: float
    stability: float
    skin: float
    max_steps: int


class Pace(NamedTuple):
    """Time step and mixing; and what the next kick does, v → keep v + (steer + …) F.

    `pending` is the half kick Δt/2 that the velocities have not been given yet.
    """

    time_step: float
    mixing: float
    downhill: int
    keep: float
    steer: float
    pending: float


@kernel
def capped(pace, limit):
    """The pace with a time step of at most `limit`."""
    time_step = min(pace.time_step, limit)
    return Pace(time_step, pace.mixing, pace.downhill, pace.keep, pace.steer, pace.pending)


@kernel
def advance(x, y, vx, vy, fx, fy, inverse_mass, pace, units, strain):
    """Pending half kick, mixing, next half kick, drift; clear F; return the longest drift.

    Clearing the forces here, while they are in the cache, saves the next pass a trip to memory.
    """
    keep, steer, kick = pace.keep, pace.steer, pace.time_step * units
    half_kicks = keep * pace.pending + 0.5 * pace.time_step
    longest = np.int64(0)
    for i in range(x.shape[0]):
        gain = steer + half_kicks * inverse_mass[i]
        vx[i] = keep * vx[i] + gain * fx[i]
        vy[i] = keep * vy[i] + gain * fy[i]
        dx, dy = np.int64(kick * (vx[i] - strain * vy[i])), np.int64(kick * vy[i])
        x[i] += dx
        y[i] += dy
        longest = max(longest, max(abs(dx), abs(dy)))
        fx[i] = 0.0
        fy[i] = 0.0
    return longest


@kernel
def work(vx, vy, fx, fy, inverse_mass, half_step):
    """F·v, v·v and F·F after the second half kick v + Δt F/2m, which is not yet stored."""
    power, speed2, force2 = 0.0, 0.0, 0.0
    for i in range(vx.shape[0]):
        kick = half_step * inverse_mass[i]
        u, w = vx[i] + kick * fx[i], vy[i] + kick * fy[i]
        power += u * fx[i] + w * fy[i]
        speed2 += u * u + w * w
        force2 += fx[i] * fx[i] + fy[i] * fy[i]
    return power, speed2, force2


@kernel
def farthest(x, y, origin_x, origin_y):
    """Largest displacement component from the origin, in 2⁻⁶⁴ L."""
    largest = np.int64(0)
    for i in range(x.shape[0]):
        largest = max(largest, max(abs(x[i] - origin_x[i]), abs(y[i] - origin_y[i])))
    return largest


@kernel
def largest_component(fx, fy):
    """max over grains and axes of |F|."""
    return max(np.abs(fx).max(), np.abs(fy).max())


@kernel
def aims(x, y, box_length, strain, neighbours, normal, inverse_mass, settings):
    """(force to reach, largest time step) at the present load of the contacts."""
    mean_force, stiffness = load(x, y, box_length, strain, neighbours, normal)
    goal = max(settings.force_tolerance, settings.balance * mean_force)
    frequency = math.sqrt(stiffness * inverse_mass.max())
    if frequency == 0.0:
        return goal, settings.largest_time_step
    return goal, min(settings.largest_time_step, settings.stability * 2.0 / frequency)


@kernel
def next_pace(pace, power, speed2, force2, limit):
    """(A8)–(A12): faster while the motion goes downhill, stop where it does not."""
    if not power > 0.0:
        return Pace(DECREASE * pace.time_step, MIXING, 0, 0.0, 0.0, 0.0)
    time_step, mixing = pace.time_step, pace.mixing
    if pace.downhill >= PATIENCE:
        time_step, mixing = min(INCREASE * time_step, limit), MIXING_DECAY * mixing
    steer = pace.mixing * math.sqrt(speed2 / force2)
    return Pace(
        time_step, mixing, pace.downhill + 1, 1.0 - pace.mixing, steer, 0.5 * pace.time_step
    )


@kernel
def fire(x, y, diameter, inverse_mass, box_length, strain, normal, settings):
    """Move the grains, in place, to force balance.

    Args: x, y (N,) int64 in 2⁻⁶⁴ L; diameter, inverse_mass (N,) float64; settings FireSettings.
    Returns: (largest force component, steps taken); the caller judges convergence.
    """
    n, skin = x.shape[0], settings.skin
    units = 1.0 / (box_length * RESOLUTION)
    free_path = np.int64(min(0.5 / math.sqrt(2.0) * skin * units / (1.0 + abs(strain)), 2e18))
    neighbours = find_neighbours(x, y, diameter, box_length, strain, skin)
    origin_x, origin_y, wandered = x.copy(), y.copy(), np.int64(0)
    vx, vy, fx, fy = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    repulsion(x, y, box_length, strain, neighbours, normal, fx, fy)
    goal, limit = aims(x, y, box_length, strain, neighbours, normal, inverse_mass, settings)
    pace = Pace(0.1 * limit, MIXING, 0, 1.0, 0.0, 0.0)
    largest, steps = largest_component(fx, fy), 0
    while largest >= goal and steps < settings.max_steps:
        steps += 1
        if steps % REVIEW == 0:
            goal, limit = aims(x, y, box_length, strain, neighbours, normal, inverse_mass, settings)
            pace = capped(pace, limit)
        wandered += advance(x, y, vx, vy, fx, fy, inverse_mass, pace, units, strain)
        if wandered > free_path:
            wandered = farthest(x, y, origin_x, origin_y)
        if wandered > free_path:
            neighbours = find_neighbours(x, y, diameter, box_length, strain, skin)
            origin_x[:], origin_y[:], wandered = x, y, np.int64(0)
        repulsion(x, y, box_length, strain, neighbours, normal, fx, fy)
        power, speed2, force2 = work(vx, vy, fx, fy, inverse_mass, 0.5 * pace.time_step)
        if not force2 > 2.0 * n * goal * goal:  # also where it is no number
            largest = largest_component(fx, fy)
        pace = next_pace(pace, power, speed2, force2, limit)
    return largest_component(fx, fy), steps
