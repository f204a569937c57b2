"""How packings are strained."""

from __future__ import annotations

from dataclasses import dataclass

STRAIN_RELAXATIONS = ("newton", "damped")


@dataclass(frozen=True)
class StepStrain:
    """The simulated rigidity: a step `strain`, relaxed to `force_tolerance` (A, Sec. II)."""

    strain: float = 1e-6
    relaxation: str = "newton"
    force_tolerance: float = 1e-14
    time_step: float = 1e-2
    damping: float = 1.0
    max_steps: int = 50_000_000
