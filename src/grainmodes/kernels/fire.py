"""FIRE: the fast inertial relaxation engine of A, Appendix A, (i)–(iv).

    v → v + Δt F/2m,   r → r + Δt v,   v → v + Δt F̃/2m               (A5), (A6)
    v → (1 − χ) v + χ |v| F̂                                          (A7), sign of F corrected
    P = F·v > 0 for N_min steps:  Δt → min(1.1 Δt, Δt_max), χ → 0.99 χ  (A8), (A9)
    P ≤ 0:  v → 0, χ → 0.1, Δt → Δt/2                                (A10)–(A12)

As printed, (A7) adds χ (v̂ − F)|v|, which steers away from the force; the formula above is that of
the method that A cites. The second half kick, the mixing (A7) and the next first half kick are one
linear combination of v and F, so a step writes each grain once and reads every pair once.

| symbol       | name          |        | symbol | name     |
| ------------ | ------------- | ------ | ------ | -------- |
| Δt_F         | time_step     |        | χ      | mixing   |
| Δt_F,max     | limit         |        | P      | power    |
| N_min        | PATIENCE      |        |        |          |
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.lanes import LANES, load, no_lanes, same_lanes, total, whole_lanes
from grainmodes.kernels.neighbours import FRACTION_UNIT, find_neighbours
from grainmodes.kernels.repulsion import mean_force_and_stiffness, repulsion

INCREASE, DECREASE, MIXING, MIXING_DECAY, PATIENCE = 1.1, 0.5, 0.1, 0.99, 5
"""f_inc, f_dec, χ_start, f_χ and N_min of paper A."""

REVIEW_INTERVAL = 50
"""Steps between two updates of the targets: the force to reach and the largest time step."""


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


class FireState(NamedTuple):
    """Time step, mixing, number of downhill steps, and the next kick, v → keep v + (steer + …) F.

    `pending` is the half kick Δt/2 that has not been added to the velocities yet.
    """

    time_step: float
    mixing: float
    downhill: int
    keep: float
    steer: float
    pending: float


@kernel
def cap_time_step(state, limit):
    """The state with its time step reduced to `limit` if it is larger."""
    time_step = min(state.time_step, limit)
    return FireState(
        time_step, state.mixing, state.downhill, state.keep, state.steer, state.pending
    )


@kernel
def advance(x, y, vx, vy, fx, fy, inverse_mass, state, units, strain):
    """Pending half kick, mixing, next half kick, drift; clear F; return the longest drift.

    The forces are cleared here, while they are in the cache, which saves a pass through memory.
    """
    keep, steer, kick = state.keep, state.steer, state.time_step * units
    half_kicks = keep * state.pending + 0.5 * state.time_step
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
def power_and_norms(vx, vy, fx, fy, inverse_mass, half_step):
    """F·v, v·v and F·F after the second half kick v + Δt F/2m, which is not yet stored."""
    n = vx.shape[0]
    half_steps = same_lanes(half_step)
    power_lanes, speed2_lanes, force2_lanes = no_lanes(), no_lanes(), no_lanes()
    for i in range(0, whole_lanes(n), LANES):
        f, g, kick = load(fx, i), load(fy, i), half_steps * load(inverse_mass, i)
        u, w = load(vx, i) + kick * f, load(vy, i) + kick * g
        power_lanes += u * f + w * g
        speed2_lanes += u * u + w * w
        force2_lanes += f * f + g * g
    power, speed2, force2 = total(power_lanes), total(speed2_lanes), total(force2_lanes)
    for i in range(whole_lanes(n), n):
        kick = half_step * inverse_mass[i]
        u, w = vx[i] + kick * fx[i], vy[i] + kick * fy[i]
        power += u * fx[i] + w * fy[i]
        speed2 += u * u + w * w
        force2 += fx[i] * fx[i] + fy[i] * fy[i]
    return power, speed2, force2


@kernel
def largest_drift(x, y, origin_x, origin_y):
    """Largest displacement component since the last list, in 2⁻⁶⁴ L."""
    largest = np.int64(0)
    for i in range(x.shape[0]):
        largest = max(largest, max(abs(x[i] - origin_x[i]), abs(y[i] - origin_y[i])))
    return largest


@kernel
def max_component(fx, fy):
    """max over grains and axes of |F|."""
    return max(np.abs(fx).max(), np.abs(fy).max())


@kernel
def targets(x, y, box_length, strain, neighbours, normal, inverse_mass, settings):
    """(max|F| at which to stop, largest time step) for the present load of the contacts."""
    mean_force, stiffness = mean_force_and_stiffness(x, y, box_length, strain, neighbours, normal)
    goal = max(settings.force_tolerance, settings.balance * mean_force)
    frequency = math.sqrt(stiffness * inverse_mass.max())
    if frequency == 0.0:
        return goal, settings.largest_time_step
    return goal, min(settings.largest_time_step, settings.stability * 2.0 / frequency)


@kernel
def next_state(state, power, speed2, force2, limit):
    """The state after (A8)–(A12): a longer step downhill, a stop and a shorter one otherwise."""
    if not power > 0.0:
        return FireState(DECREASE * state.time_step, MIXING, 0, 0.0, 0.0, 0.0)
    time_step, mixing = state.time_step, state.mixing
    if state.downhill >= PATIENCE:
        time_step, mixing = min(INCREASE * time_step, limit), MIXING_DECAY * mixing
    steer = state.mixing * math.sqrt(speed2 / force2)
    return FireState(
        time_step, mixing, state.downhill + 1, 1.0 - state.mixing, steer, 0.5 * state.time_step
    )


@kernel
def fire(x, y, diameter, inverse_mass, box_length, strain, normal, settings):
    """Move the grains, in place, to force balance.

    Args: x, y (N,) int64 in 2⁻⁶⁴ L; diameter, inverse_mass (N,) float64; settings FireSettings.
    Returns: (largest force component, steps taken); the caller judges convergence.
    """
    n, skin = x.shape[0], settings.skin
    units = 1.0 / (box_length * FRACTION_UNIT)
    allowed_drift = np.int64(min(0.5 / math.sqrt(2.0) * skin * units / (1.0 + abs(strain)), 2e18))
    neighbours = find_neighbours(x, y, diameter, box_length, strain, skin)
    origin_x, origin_y, drift = x.copy(), y.copy(), np.int64(0)
    vx, vy, fx, fy = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
    repulsion(x, y, box_length, strain, neighbours, normal, fx, fy)
    goal, limit = targets(x, y, box_length, strain, neighbours, normal, inverse_mass, settings)
    state = FireState(0.1 * limit, MIXING, 0, 1.0, 0.0, 0.0)
    largest, steps = max_component(fx, fy), 0
    while largest >= goal and steps < settings.max_steps:
        steps += 1
        if steps % REVIEW_INTERVAL == 0:
            goal, limit = targets(
                x, y, box_length, strain, neighbours, normal, inverse_mass, settings
            )
            state = cap_time_step(state, limit)
        drift += advance(x, y, vx, vy, fx, fy, inverse_mass, state, units, strain)
        if drift > allowed_drift:
            drift = largest_drift(x, y, origin_x, origin_y)
        if drift > allowed_drift:
            neighbours = find_neighbours(x, y, diameter, box_length, strain, skin)
            origin_x[:], origin_y[:], drift = x, y, np.int64(0)
        repulsion(x, y, box_length, strain, neighbours, normal, fx, fy)
        power, speed2, force2 = power_and_norms(vx, vy, fx, fy, inverse_mass, 0.5 * state.time_step)
        if not force2 > 2.0 * n * goal * goal:  # true for NaN too
            largest = max_component(fx, fy)
        state = next_state(state, power, speed2, force2, limit)
    return max_component(fx, fy), steps
