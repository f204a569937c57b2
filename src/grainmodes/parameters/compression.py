"""How packings are made."""

from __future__ import annotations

from dataclasses import dataclass

RELAXATIONS = ("fire_newton", "fire")

PREPARATIONS = ("frictionless", "frictional")
"""How the packings of a grid are compressed: as A does it, or as B does it."""


@dataclass(frozen=True)
class Compression:
    """Random placement at φ = `initial_phi`, then steps of `phi_step`, each relaxed (A, App. A).

    Half of the grains have `large_diameter`, the others 1/1.4 of it; `masses` are d_i² ("area": A,
    B) or all 1 ("equal": C, whose unit of length is the small diameter, so its large one is 1.4).
    `intermediate_balance` is the largest force left after a step, relative to the mean contact
    force (`fire_newton` only: `fire` brings every step to `force_tolerance`, as paper A does).
    """

    relaxation: str = "fire_newton"
    initial_phi: float = 0.6
    phi_step: float = 1e-4
    intermediate_balance: float = 1e-3
    force_tolerance: float = 1e-14
    max_iterations: int = 20_000_000
    large_diameter: float = 1.0
    masses: str = "area"


@dataclass(frozen=True)
class FrictionalCompression:
    """How each step of φ is relaxed where grains are compressed with friction (B, Sec. II).

    The damped dynamics has the background drag `drag` = η_D, and the time step `time_step` where
    k_T ≤ k_N; beyond, it is shorter by (k_N/k_T)^(1/2), as the fastest oscillation is. A step of φ
    ends where max|F̃| is the part `balance` of the mean contact force, or after `max_steps`.
    """

    drag: float = 1.0
    time_step: float = 0.1
    balance: float = 1e-2
    max_steps: int = 20_000
