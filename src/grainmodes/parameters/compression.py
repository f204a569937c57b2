"""How packings are made."""

from __future__ import annotations

from dataclasses import dataclass

RELAXATIONS = ("fast", "fire")


@dataclass(frozen=True)
class Compression:
    """Random placement at φ = `initial_phi`, then steps of `phi_step`, each relaxed (A, App. A).

    `intermediate_balance` is the largest force left after a step, relative to the mean contact
    force (`fast` only: `fire` brings every step to `force_tolerance`, as paper A does).
    """

    relaxation: str = "fast"
    initial_phi: float = 0.6
    phi_step: float = 1e-4
    intermediate_balance: float = 1e-3
    force_tolerance: float = 1e-14
    max_iterations: int = 20_000_000
