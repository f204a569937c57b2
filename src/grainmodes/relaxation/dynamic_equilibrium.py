"""The equilibrium that the damped dynamics chooses, refined by Newton's method.

The dynamics decides which contacts open and close. It runs until max|F̃| is a small part of the mean
contact force, and Newton's method goes on from there to the bottom of the basin. Where Newton's
method would leave the basin, the dynamics goes on to ever smaller forces, in the end to F_Th.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import mean_contact_force
from grainmodes.packing.state import Packing
from grainmodes.relaxation.equilibrium_search import find_equilibrium
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.relaxation.result import RelaxationResult

HANDOVER_FORCE_RATIO = 1e-4
"""max|F̃|, relative to the mean contact force, at which Newton's method takes over from the
dynamics, which by then has decided which contacts open and close (docs/numerics.md)."""

HANDOVER_REDUCTION = 0.1
"""Factor by which the handover force is lowered where Newton's method leaves the basin."""

Relax = Callable[[Packing, float, int], RelaxationResult]
"""Relaxes a packing until max|F̃| is below a tolerance, in at most so many steps."""


def equilibrium_by_dynamics(
    packing: Packing,
    interaction: Interaction,
    relax: Relax,
    tolerance: float,
    max_steps: int,
    before: EquilibriumState | None = None,
    handover: float = HANDOVER_FORCE_RATIO,
) -> tuple[EquilibriumState, int]:
    """The stable equilibrium that the dynamics leads to, and the number of its steps.

    Args:
        relax: the dynamics.
        tolerance: F_Th, max|F̃| of the equilibrium, in k_N d^(3/2).
        before: the state that the packing comes from, whose factors are reused.
        handover: max|F̃|, relative to the mean contact force, at which Newton's method is first
            tried; 0 leaves everything to the dynamics.

    Raises:
        ArithmeticError: no equilibrium was found within `max_steps` steps.
        PackingError: two grains lie at the same place.
    """
    steps = 0
    allowed = max(handover * mean_contact_force(packing, interaction), tolerance)
    while steps < max_steps:
        relaxed = relax(packing, allowed, max_steps - steps)
        packing, steps = relaxed.packing, steps + relaxed.iterations
        is_last = allowed <= tolerance
        max_released_force = np.inf if is_last else tolerance
        found = find_equilibrium(packing, interaction, tolerance, before, max_released_force)
        if found is not None and not found.unstable:
            return found, steps
        if is_last:
            break
        allowed = max(HANDOVER_REDUCTION * allowed, tolerance)
    raise ArithmeticError(
        f"strain {packing.strain}: no stable equilibrium, max|F| = {relaxed.max_force:.1e} after "
        f"{steps} steps of the dynamics"
    )
