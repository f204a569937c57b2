"""Relaxation of frictionless packings: FIRE as in paper A, and the faster way that is the default.

`relax_fire` is A's Appendix A to the letter: Δt_max = 0.1 t_0, masses m_i, every grain, down to
F_Th. `relax_fire_newton` takes FIRE with the largest stable step only until the forces are a small
fraction of the mean contact force. Then it solves the balance of the backbone by Newton's method
and moves the rattlers until they touch nothing. If Newton's method leaves the basin of attraction,
FIRE continues to a tenth of that fraction.

A balance is judged relative to the mean contact force f̄: 1e-6 is 0.03 % of f̄ at φ = 0.90, but 5 %
at φ = 0.843, from where Newton's method would reach another minimum.

| symbol  | name           | unit        |
| ------- | -------------- | ----------- |
| F_Th    | tolerance      | k_N d^(3/2) |
| max|F|  | max_force      | k_N d^(3/2) |
| Δt_max  | time step      | t_0         |
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from grainmodes.kernels.fire import FireSettings, fire
from grainmodes.kernels.laws import Frictionless, Interaction, NormalLaw
from grainmodes.packing.forces import max_force_and_torque, mean_contact_force, net_force
from grainmodes.packing.state import Packing, rattlers
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.rattlers import detach_rattlers
from grainmodes.relaxation.result import RelaxationResult

PAPER_TIME_STEP = 0.1
"""Δt_F,max = 10 Δt_F,ini = 0.1 t_0 of A, Appendix A."""

STABILITY_FRACTION = 1.1
"""Largest step of the fast FIRE in units of 2/ω, where ω bounds ω_max from the contact stiffnesses.

The bound exceeds ω_max by 1.5, so that the step is 0.75 of the largest stable one."""

NO_TIME_STEP_LIMIT = 1e3
"""A largest time step, or a largest fraction of the stable one, that is never reached."""

SKIN = 0.2
"""Verlet skin in d."""

NEWTON_START = 1e-5
"""max|F| relative to f̄ at which Newton's method is first tried."""

UNJAMMED_FORCE = 1e-10
"""Mean contact force, in k_N d^(3/2), below which a packing counts as unjammed."""

FIRE_SAFETY_FACTOR = 0.9
"""FIRE stops at this fraction of F_Th: summed in another order, forces differ by up to 5e-16."""


def relax_fire(
    packing: Packing, normal: NormalLaw, tolerance: float, max_iterations: int
) -> RelaxationResult:
    """Relax by A's FIRE: every grain with its mass, Δt ≤ 0.1 t_0, until max|F| < `tolerance`.

    Raises:
        ArithmeticError: a force is NaN or infinite.
    """
    settings = FireSettings(
        tolerance, 0.0, PAPER_TIME_STEP, NO_TIME_STEP_LIMIT, SKIN, max_iterations
    )
    return _fire(packing, normal, settings, 1.0 / packing.mass)


def relax_fire_large_steps(
    packing: Packing,
    normal: NormalLaw,
    tolerance: float,
    relative_tolerance: float,
    max_iterations: int,
) -> RelaxationResult:
    """Relax by FIRE with the largest stable step and unit masses.

    It stops at max|F| < max(`tolerance`, `relative_tolerance` · f̄).

    Raises:
        ArithmeticError: a force is NaN or infinite.
    """
    settings = FireSettings(
        tolerance, relative_tolerance, NO_TIME_STEP_LIMIT, STABILITY_FRACTION, SKIN, max_iterations
    )
    return _fire(packing, normal, settings, np.ones(packing.n))


def relax_fire_newton(
    packing: Packing, normal: NormalLaw, tolerance: float, max_iterations: int
) -> RelaxationResult:
    """Relax until max|F| < `tolerance`: FIRE, then Newton's method, then rattlers are detached.

    Raises:
        ArithmeticError: a force is NaN or infinite.
    """
    relative_tolerance, steps = NEWTON_START, 0
    while True:
        rough = relax_fire_large_steps(
            packing, normal, tolerance, relative_tolerance, max_iterations - steps
        )
        steps += rough.iterations
        if rough.max_force < tolerance or steps >= max_iterations:
            return replace(rough, iterations=steps, converged=rough.max_force < tolerance)
        polished = _polished(rough.packing, normal, tolerance)
        if polished is not None:
            return replace(polished, iterations=steps + polished.iterations)
        packing = rough.packing
        relative_tolerance *= 0.1


def _fire(
    packing: Packing,
    normal: NormalLaw,
    settings: FireSettings,
    inverse_mass: NDArray[np.float64],
) -> RelaxationResult:
    """FIRE with these settings and inverse masses (N,).

    Raises:
        ArithmeticError: a force is NaN or infinite.
    """
    x, y = packing.fraction.copy()
    max_force, steps = fire(
        x,
        y,
        packing.diameter,
        inverse_mass,
        packing.box_length,
        packing.strain,
        normal,
        settings._replace(force_tolerance=FIRE_SAFETY_FACTOR * settings.force_tolerance),
    )
    if not np.isfinite(max_force):
        raise ArithmeticError("a force is NaN or infinite: two grains may lie at the same place")
    relaxed = replace(packing, fraction=np.stack([x, y]))
    return RelaxationResult(relaxed, max_force < settings.force_tolerance, steps, max_force)


def _polished(packing: Packing, normal: NormalLaw, tolerance: float) -> RelaxationResult | None:
    """Newton's method on the backbone, rattlers detached; None where that finds no balance."""
    interaction = Interaction(normal, Frictionless())
    is_rattler = rattlers(packing, threshold=2)
    if is_rattler.all():
        return None
    solved = newton(packing.without(is_rattler), interaction, tolerance)
    if not solved.converged:
        return None
    fraction = packing.fraction.copy()
    fraction[:, ~is_rattler] = solved.packing.fraction
    settled = detach_rattlers(replace(packing, fraction=fraction), normal, is_rattler)
    force = net_force(settled, interaction)
    max_force, _ = max_force_and_torque(force)
    if not max_force < tolerance:
        return None
    return RelaxationResult(settled, True, solved.iterations, max_force)


def is_unjammed(packing: Packing, normal: NormalLaw) -> bool:
    """Whether the mean contact force of a packing is too small for it to carry load."""
    interaction = Interaction(normal, Frictionless())
    return mean_contact_force(packing, interaction) < UNJAMMED_FORCE
