"""How packings are strained."""

from __future__ import annotations

from dataclasses import dataclass

STRAIN_RELAXATIONS = ("newton", "damped")
LOWEST_EIGENVALUES = ("events", "states")

MAX_PAIR_DOF = 1200
"""Most degrees of freedom at which the complex pairs after an event are counted."""


@dataclass(frozen=True)
class StepStrain:
    """The simulated rigidity: a step `strain`, relaxed to `force_tolerance` (A, Sec. II)."""

    strain: float = 1e-6
    relaxation: str = "newton"
    force_tolerance: float = 1e-14
    time_step: float = 1e-2
    damping: float = 1.0
    max_steps: int = 50_000_000


@dataclass(frozen=True)
class Shear:
    """Athermal quasistatic shear from 0 to `strain` in steps of `step` (B, Sec. II, App. B).

    A step with an event is taken back and divided by ten, down to `min_step`. With "newton" the
    damped dynamics, with `time_step` in t_0 and `drag` in 1/t_0, is used only where Newton's method
    cannot decide. The lowest eigenvalue of J is computed on both sides of all "events", or of all
    "states". If `loaded`, the affine motion stretches the tangential springs.
    """

    strain: float = 0.5
    step: float = 1e-4
    min_step: float = 1e-8
    relaxation: str = "newton"
    loaded: bool = False
    force_tolerance: float = 1e-14
    time_step: float = 0.1
    drag: float = 1.0
    max_steps: int = 20_000_000
    lowest_eigenvalue: str = "events"
