"""Dynamics of grains with tangential history and damping: A (1)–(9), Appendix B.

Velocity Verlet whose forces see the half-kicked velocity Q̇, A (B7)–(B9):

    Q̇ = q̇ + Δt f̃/2,   q → q + Δt Q̇,   f̃ = f̃(q, Q̇),   q̇ → Q̇ + Δt f̃/2
    s → s + t·δr + δℓ  with t at the middle of the step; s = 0 where the pair does not touch
    h → h + k_T w(ξ) (t·δr + δℓ)  where the law remembers a force, ξ at the middle too
    f = f_N n + f_T t − η (v_rel + t (w_i + w_j)),   scaled torque f_T − η (t·v_rel + w_i + w_j)

with w = dℓ/dt and inertia m/2 of ℓ. Second order in q; first order in q̇ where f depends on q̇.
Every velocity is that of q = (x, y, ℓ), in d/t_0.

| symbol    | name        | shape, type            |
| --------- | ----------- | ---------------------- |
| q̇         | vx, vy, w   | (N,) float64           |
| s or h    | spring      | (P,) float64, per pair |
| η         | damping     | a type of damping.py   |
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.cache_blocks import GRAINS_PER_BLOCK, pair_scratch
from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.damping import drag_rate, pair_viscosity, rotational_drag_rate
from grainmodes.kernels.laws import (
    advance_spring,
    clip_to_coulomb,
    normal_response,
    tangential_response,
)
from grainmodes.kernels.neighbours import FRACTION_UNIT, find_neighbours, separation


class Grains(NamedTuple):
    """Positions (N,) int64 in 2⁻⁶⁴ L; velocities, forces and mass (N,) float64."""

    x: np.ndarray
    y: np.ndarray
    vx: np.ndarray
    vy: np.ndarray
    w: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    torque: np.ndarray
    rotation: np.ndarray
    mass: np.ndarray
    diameter: np.ndarray


class Stop(NamedTuple):
    """When to stop: residual motion < tolerance, every CHECK_INTERVAL steps, or after `steps`."""

    tolerance: float
    steps: int


CHECK_INTERVAL = 20
"""Steps between two checks of the residual motion, whose maxima cost as much as a kick."""

MIN_OVERLAP = 1e-300
"""Overlap used for a pair that does not touch, so that its (unused) force is finite."""


@kernel
def pair_forces(
    grains, box_length, strain, time_step, pairs, begin, interaction, damping, spring, pair_force
):
    """Advance the springs of a block of pairs, from number `begin` on, and write their forces.

    pair_force (3, P') receives (f_x, f_y, scaled torque) on grain i of every pair of the block.
    """
    scale = box_length * FRACTION_UNIT
    left, right, contact_distance = pairs.left, pairs.right, pairs.contact_distance
    x, y, vx, vy, w = grains.x, grains.y, grains.vx, grains.vy, grains.w
    viscosity = pair_viscosity(damping)
    for k in range(pair_force.shape[1]):
        pair = begin + k
        i, j = left[pair], right[pair]
        dx, dy = separation(x, y, i, j, scale, strain)
        ux, uy, spin = vx[i] - vx[j], vy[i] - vy[j], w[i] + w[j]
        distance = math.sqrt(dx * dx + dy * dy)
        overlap = contact_distance[pair] - distance
        touch = 1.0 if overlap > 0.0 else 0.0
        overlap = max(overlap, MIN_OVERLAP)
        mx, my = dx - 0.5 * time_step * ux, dy - 0.5 * time_step * uy
        middle = math.sqrt(mx * mx + my * my)
        slide = (my * ux - mx * uy) / middle + spin
        s = advance_spring(
            interaction.tangential,
            interaction.normal,
            max(contact_distance[pair] - middle, MIN_OVERLAP),
            spring[pair],
            time_step * slide,
        )
        s = clip_to_coulomb(interaction.tangential, interaction.normal, overlap, touch * s)
        spring[pair] = s
        f_n, _ = normal_response(interaction.normal, overlap)
        f_t, _, _ = tangential_response(interaction.tangential, interaction.normal, overlap, s)
        nx, ny = dx / distance, dy / distance
        f_n = touch * (f_n - viscosity * (nx * ux + ny * uy))
        f_t = touch * (f_t - viscosity * (ny * ux - nx * uy + spin))
        pair_force[0, k] = f_n * nx + f_t * ny
        pair_force[1, k] = f_n * ny - f_t * nx
        pair_force[2, k] = f_t


@kernel
def add_to_grains(pairs, begin, end, pair_force, fx, fy, torque):
    """Add the forces of the pairs whose left grain is begin … end − 1 to both partners."""
    first, right = pairs.first, pairs.right
    base = first[begin]
    for i in range(begin, end):
        sum_x, sum_y, sum_t = 0.0, 0.0, 0.0
        for pair in range(first[i], first[i + 1]):
            j = right[pair]
            px, py, pt = (
                pair_force[0, pair - base],
                pair_force[1, pair - base],
                pair_force[2, pair - base],
            )
            sum_x += px
            sum_y += py
            sum_t += pt
            fx[j] -= px
            fy[j] -= py
            torque[j] += pt
        fx[i] += sum_x
        fy[i] += sum_y
        torque[i] += sum_t


@kernel
def contact_pass(
    grains, box_length, strain, time_step, pairs, interaction, damping, spring, scratch
):
    """Advance all springs and add all contact forces; forces must have been cleared."""
    n = grains.x.shape[0]
    for begin in range(0, n, GRAINS_PER_BLOCK):
        end = min(begin + GRAINS_PER_BLOCK, n)
        low, high = pairs.first[begin], pairs.first[end]
        block_force = scratch[:, : high - low]
        pair_forces(
            grains,
            box_length,
            strain,
            time_step,
            pairs,
            low,
            interaction,
            damping,
            spring,
            block_force,
        )
        add_to_grains(pairs, begin, end, block_force, grains.fx, grains.fy, grains.torque)


@kernel
def kick_and_drift(grains, half_step, time_step, units, strain):
    """First half kick and drift; clear the forces; return the longest drift in 2⁻⁶⁴ L."""
    kick = time_step * units
    longest = np.int64(0)
    for i in range(grains.x.shape[0]):
        gain = half_step / grains.mass[i]
        grains.vx[i] += gain * grains.fx[i]
        grains.vy[i] += gain * grains.fy[i]
        grains.w[i] += 2.0 * gain * grains.torque[i]
        dx = np.int64(kick * (grains.vx[i] - strain * grains.vy[i]))
        dy = np.int64(kick * grains.vy[i])
        grains.x[i] += dx
        grains.y[i] += dy
        grains.rotation[i] += time_step * grains.w[i]
        longest = max(longest, max(abs(dx), abs(dy)))
        grains.fx[i] = 0.0
        grains.fy[i] = 0.0
        grains.torque[i] = 0.0
    return longest


@kernel
def second_kick(grains, half_step, damping):
    """Add the drag to the forces and give the second half kick."""
    rate, spin_rate = drag_rate(damping), rotational_drag_rate(damping)
    for i in range(grains.x.shape[0]):
        mass = grains.mass[i]
        gain = half_step / mass
        grains.fx[i] -= rate * mass * grains.vx[i]
        grains.fy[i] -= rate * mass * grains.vy[i]
        grains.torque[i] -= 0.5 * spin_rate * mass * grains.w[i]
        grains.vx[i] += gain * grains.fx[i]
        grains.vy[i] += gain * grains.fy[i]
        grains.w[i] += 2.0 * gain * grains.torque[i]


@kernel
def residual_motion(grains):
    """max over grains of the force and velocity components, in k_N d^(3/2) and d/t_0.

    Infinite if one of them is NaN or infinite: a maximum may skip a NaN, a sum does not.

    A judges the force with damping alone. A slow overdamped creep meets that too, while the contact
    forces are still many times F_Th and only balanced by the dashpots.
    """
    force = max(np.abs(grains.fx).max(), np.abs(grains.fy).max())
    velocity = max(np.abs(grains.vx).max(), np.abs(grains.vy).max())
    turning = max(np.abs(grains.torque).max(), np.abs(grains.w).max())
    numbers = 0.0
    for i in range(grains.x.shape[0]):
        numbers += grains.fx[i] + grains.fy[i] + grains.torque[i]
        numbers += grains.vx[i] + grains.vy[i] + grains.w[i]
    if not np.isfinite(numbers):
        return np.inf
    return max(force, max(velocity, turning))


@kernel
def transfer_springs(old, spring, new):
    """The springs (P,) of a new list: those of its pairs in the old list, 0 for all others."""
    moved = np.zeros(new.left.shape[0])
    for i in range(new.first.shape[0] - 1):
        for pair in range(new.first[i], new.first[i + 1]):
            for before in range(old.first[i], old.first[i + 1]):
                if old.right[before] == new.right[pair]:
                    moved[pair] = spring[before]
    return moved


@kernel
def integrate(
    grains, box_length, strain, pairs, spring, interaction, damping, time_step, skin, stop
):
    """Integrate until the residual motion is below stop.tolerance or infinite, or stop.steps steps.

    Args: grains (changed in place); pairs, the Verlet list; spring (P,), its springs.
    Returns: (pairs, spring, steps taken, residual motion).
    """
    units = 1.0 / (box_length * FRACTION_UNIT)
    half_step = 0.5 * time_step
    allowed_drift = np.int64(0.5 / math.sqrt(2.0) * skin * units / (1.0 + abs(strain)))
    scratch = pair_scratch(pairs, 3)
    drift, steps = np.int64(0), 0
    contact_pass(grains, box_length, strain, 0.0, pairs, interaction, damping, spring, scratch)
    second_kick(
        grains, 0.0, damping
    )  # adds only the drag, so that a run in pieces equals the whole run
    motion = np.inf
    while steps < stop.steps and (steps < CHECK_INTERVAL or stop.tolerance <= motion < np.inf):
        steps += 1
        drift += kick_and_drift(grains, half_step, time_step, units, strain)
        if drift > allowed_drift:
            fresh = find_neighbours(grains.x, grains.y, grains.diameter, box_length, strain, skin)
            spring = transfer_springs(pairs, spring, fresh)
            pairs, scratch, drift = fresh, pair_scratch(fresh, 3), np.int64(0)
        contact_pass(
            grains, box_length, strain, time_step, pairs, interaction, damping, spring, scratch
        )
        second_kick(grains, half_step, damping)
        if steps % CHECK_INTERVAL == 0 or steps == stop.steps:
            motion = residual_motion(grains)
    return pairs, spring, steps, motion
