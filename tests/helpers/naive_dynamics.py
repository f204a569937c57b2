"""Slow twins of the two ways to move: FIRE as in A, App. A, and velocity Verlet as in A, App. B.

One step per function, absolute positions, and all pairs searched in every step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import naive
from grainmodes.parameters.law import ContactLaw

F_INC, F_DEC, CHI_START, F_CHI, N_MIN = 1.1, 0.5, 0.1, 0.99, 5
DT_INITIAL, DT_MAX = 0.01, 0.1
"""The constants of A, App. A."""


@dataclass
class Fire:
    """Where FIRE stands: (N, 2) arrays and its three numbers."""

    position: np.ndarray
    velocity: np.ndarray
    time_step: float = DT_INITIAL
    chi: float = CHI_START
    downhill: int = 0


def repulsion(law, position, diameter, box_length, strain):
    """F of every grain without friction, (N, 2)."""
    pairs = naive.all_pairs(position, diameter, box_length, strain)
    return naive.net_force(law, pairs, len(diameter))[:, :2]


def fire_step(now: Fire, force, mass: np.ndarray) -> Fire:
    """One round of (i)–(iv): A (A5)–(A12), F in (A7) read as the unit vector it must be."""
    dt, before = now.time_step, force(now.position)
    position = now.position + dt * now.velocity + dt**2 * before / (2 * mass[:, None])
    after = force(position)
    velocity = now.velocity + dt * (after + before) / (2 * mass[:, None])
    power = np.sum(after * velocity)
    speed, strength = np.linalg.norm(velocity), np.linalg.norm(after)
    if not power > 0:
        return Fire(position, np.zeros_like(velocity), dt * F_DEC, CHI_START, 0)
    velocity = velocity + now.chi * (after / strength * speed - velocity)
    if now.downhill + 1 <= N_MIN:
        return Fire(position, velocity, dt, now.chi, now.downhill + 1)
    return Fire(position, velocity, min(dt * F_INC, DT_MAX), now.chi * F_CHI, now.downhill + 1)


@dataclass
class Moving:
    """Grains on the move: position (N, 2), velocity and force (N, 3) of (x, y, ℓ), s by pair."""

    position: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    slip: dict[tuple[int, int], float]


@dataclass
class Scene:
    """What does not change while grains move; `viscosity` of A, `drag` of B, of translations alone
    in C."""

    law: ContactLaw
    diameter: np.ndarray
    mass: np.ndarray
    box_length: float
    strain: float = 0.0
    viscosity: float = 0.0
    drag: float = 0.0
    drags_rotation: bool = True

    @property
    def inertia(self) -> np.ndarray:
        """m, m and 4 I/d² = m/2."""
        return self.mass[:, None] * np.array([1.0, 1.0, 0.5])


def pairs_at(scene: Scene, position, slip) -> list[naive.Pair]:
    """The touching pairs, with the s that is known."""
    return naive.all_pairs(position, scene.diameter, scene.box_length, scene.strain, slip=slip)


def viscous(scene: Scene, pair: naive.Pair, velocity) -> np.ndarray:
    """−η (v_N + v_T) on grain i, and the scaled torque of its tangential part: A (7), (8)."""
    along = velocity[pair.i] + naive.ON_J * velocity[pair.j]
    t = naive.tangent(pair.branch)
    normal = pair.branch / naive.length(pair.branch)
    sliding = t @ along[:2] + along[2]
    force = (normal @ along[:2]) * normal + sliding * t
    return -scene.viscosity * np.append(force, sliding)


def damped_force(scene: Scene, pairs: list[naive.Pair], velocity) -> np.ndarray:
    """F̃ with every damping, (N, 3)."""
    dragged = scene.inertia * np.array([1.0, 1.0, float(scene.drags_rotation)])
    total = naive.net_force(scene.law, pairs, len(scene.mass)) - scene.drag * dragged * velocity
    for pair in pairs:
        force = viscous(scene, pair, velocity)
        total[pair.i] += force
        total[pair.j] += naive.ON_J * force
    return total


def verlet_step(scene: Scene, now: Moving, dt: float) -> Moving:
    """One step of A (B17)–(B19): the new force sees the half-kicked velocity."""
    half = now.velocity + dt / 2 * now.force / scene.inertia
    position = now.position + dt * half[:, :2]
    touching = pairs_at(scene, position, now.slip)
    slip = {(p.i, p.j): slipped(scene.law, p, dt * half) for p in touching}
    force = damped_force(scene, pairs_at(scene, position, slip), half)
    return Moving(position, half + dt / 2 * force / scene.inertia, force, slip)


def slipped(law: ContactLaw, pair: naive.Pair, u) -> float:
    """s of a pair that touches after the motion u; it was 0 if the pair did not touch before."""
    step = u[pair.i] + naive.ON_J * u[pair.j]
    s = naive.moved(law, pair._replace(branch=pair.branch - step[:2]), step).slip
    if not law.tangential.startswith("sharp_coulomb"):
        return s
    limit = naive.threshold(law, pair.reach - naive.length(pair.branch))
    return float(np.clip(s, -limit, limit))


def energy(scene: Scene, now: Moving) -> float:
    """Kinetic, normal and tangential energy; the last of harmonic elastic contacts only."""
    pairs = pairs_at(scene, now.position, now.slip)
    overlap = np.array([p.reach - naive.length(p.branch) for p in pairs])
    slip = np.array([p.slip for p in pairs])
    stored = overlap**2 / 2 if scene.law.normal == "harmonic" else overlap**2.5 * 2 / 5
    kinetic = np.sum(scene.inertia * now.velocity**2) / 2
    return kinetic + stored.sum() + scene.law.kt * np.sum(slip**2) / 2


def released(scene: Scene, position, velocity) -> Moving:
    """Grains at `position` with `velocity` and unloaded springs."""
    force = damped_force(scene, pairs_at(scene, position, {}), velocity)
    return Moving(position, velocity, force, {})
