"""How packings are made."""

from __future__ import annotations

from dataclasses import dataclass

RELAXATIONS = ("fire_newton", "fire")


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
