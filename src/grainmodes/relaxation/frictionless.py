"""Relaxing frictionless packings: FIRE as in paper A, and the fast way that is the default.

`relax_fire` is A's Appendix A to the letter: Δt_max = 0.1 t_0, masses m_i, every grain, down to
F_Th. `relax_fast` takes FIRE with the largest stable step only until the forces are a small
fraction of the mean contact force, then solves the balance of the backbone by Newton's method and
moves the rattlers out of the way. If Newton leaves the basin, FIRE goes on to a tenth of that.

A balance is judged relative to the mean contact force f̄: 1e-6 is 0.03 % of f̄ at φ = 0.90 and
5 % at φ = 0.843, from where Newton would wander off to another minimum.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainmodes.kernels.fire import FireSettings, fire
from grainmodes.kernels.laws import Frictionless, Interaction
from grainmodes.packing.contacts import rattlers
from grainmodes.packing.forces import largest, mean_contact_force, net_force
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.rattlers import moved_out
from grainmodes.relaxation.result import Relaxed

PAPER_TIME_STEP = 0.1
"""Δt_F,max = 10 Δt_F,ini = 0.1 t_0 of A, Appendix A."""

STABILITY = 1.1
"""Largest step of the fast FIRE in units of 2/ω, where ω bounds ω_max from the contact stiffnesses.

The bound exceeds ω_max by 1.5, so the step is 0.75 of the stable one."""

SKIN = 0.2
"""Verlet skin in d."""

BASIN = 1e-5
"""Forces relative to f̄ at which Newton is first tried."""

FLOPPY_FORCE = 1e-10
"""Mean contact force below which a packing on its way is held to be unjammed."""

UNLIMITED = 1e3

MARGIN = 0.9
"""FIRE stops at this part of F_Th: summed in another order, the forces differ by up to 5e-16."""


def relax_fire(packing: Packing, normal, tolerance: float, max_iterations: int) -> Relaxed:
    """A's FIRE: every grain with its mass, Δt ≤ 0.1 t_0, until max|F| < `tolerance`."""
    settings = FireSettings(tolerance, 0.0, PAPER_TIME_STEP, UNLIMITED, SKIN, max_iterations)
    return _fire(packing, normal, settings, 1.0 / packing.mass)


def relax_loosely(
    packing: Packing, normal, tolerance: float, balance: float, max_iterations: int
) -> Relaxed:
    """FIRE with the largest stable step until max|F| < max(`tolerance`, `balance` · f̄)."""
    settings = FireSettings(tolerance, balance, UNLIMITED, STABILITY, SKIN, max_iterations)
    return _fire(packing, normal, settings, np.ones(packing.n))


def relax_fast(packing: Packing, normal, tolerance: float, max_iterations: int) -> Relaxed:
    """FIRE into the basin, Newton on the backbone, rattlers out: max|F| < `tolerance`."""
    balance, steps = BASIN, 0
    while True:
        loose = relax_loosely(packing, normal, tolerance, balance, max_iterations - steps)
        steps += loose.iterations
        if loose.max_force < tolerance or steps >= max_iterations:
            return replace(loose, iterations=steps, converged=loose.max_force < tolerance)
        polished = _polished(loose.packing, normal, tolerance)
        if polished is not None:
            return replace(polished, iterations=steps + polished.iterations)
        packing = loose.packing
        balance *= 0.1


def _fire(packing: Packing, normal, settings: FireSettings, inverse_mass: np.ndarray) -> Relaxed:
    """FIRE with these settings.

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
        settings._replace(force_tolerance=MARGIN * settings.force_tolerance),
    )
    if not np.isfinite(max_force):
        raise ArithmeticError("a force is NaN or infinite: two grains may lie at the same place")
    relaxed = replace(packing, fraction=np.stack([x, y]))
    return Relaxed(relaxed, max_force < settings.force_tolerance, steps, max_force)


def _polished(packing: Packing, normal, tolerance: float) -> Relaxed | None:
    """Newton on the backbone and rattlers moved out; None where that does not reach balance."""
    interaction = Interaction(normal, Frictionless())
    gone = rattlers(find_contacts(packing), packing.n, threshold=2)
    if gone.all():
        return None
    solved = newton(packing.without(gone), interaction, tolerance)
    if not solved.converged:
        return None
    fraction = packing.fraction.copy()
    fraction[:, ~gone] = solved.packing.fraction
    settled = moved_out(replace(packing, fraction=fraction), normal, gone)
    force = net_force(settled, find_contacts(settled), interaction)
    max_force, _ = largest(force)
    return Relaxed(settled, True, solved.iterations, max_force) if max_force < tolerance else None


def unjammed(packing: Packing, normal) -> bool:
    """Whether a packing on its way bears no load yet."""
    interaction = Interaction(normal, Frictionless())
    return mean_contact_force(find_contacts(packing), interaction) < FLOPPY_FORCE
