"""One step of athermal quasistatic shear: an affine strain, then relaxation to equilibrium: B.

    r_i → r_i + Δγ (y_i, 0),   then J u = F̃ until max|F̃| < F_Th

The affine strain leaves the tangential springs alone (`unloaded`, B), or stretches them as a
continuous shear would (`loaded`): s → s + Δγ t·(r_y, 0), with t in the middle of the step.

The equilibrium to which a step leads is defined by B's damped dynamics, q̈ = M⁻¹F̃ − η q̇ from the
affine state. Newton's method finds the same one as long as the equilibrium moves on continuously.
It cannot decide

- where it finds no equilibrium, or a saddle of J;
- where a contact opens that still bears a tangential force. A harmonic contact without slip bears
  k_T s at zero overlap and releases this force at once. It may close again with s = 0, and where it
  does depends on the path.

In these cases the dynamics decides, and Newton's method only refines its final state.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainmodes.kernels.damping import Drag
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_by_slide
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import is_frictionless, mean_contact_force
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.equilibrium_search import find_equilibrium
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.relaxation.frictionless import relax_fire_newton
from grainmodes.relaxation.result import RelaxationResult

HANDOVER_FORCE_RATIO = 1e-4
"""max|F̃|, relative to the mean contact force, at which Newton's method takes over from the
dynamics, which by then has decided which contacts open and close (docs/numerics.md)."""

HANDOVER_REDUCTION = 0.1
"""Factor by which the handover force is lowered where Newton's method leaves the basin."""


def first_equilibrium(
    packing: Packing, interaction: Interaction, choices: Shear
) -> EquilibriumState:
    """The stable equilibrium of a packing that is in balance already, or nearly.

    Raises:
        ArithmeticError: there is no stable equilibrium nearby.
    """
    found = find_equilibrium(packing, interaction, choices.force_tolerance)
    if found is None or found.unstable:
        raise ArithmeticError(f"no stable equilibrium near the packing at strain {packing.strain}")
    return found


def step_to(
    strain: float, before: EquilibriumState, choices: Shear
) -> tuple[EquilibriumState, bool]:
    """The equilibrium at another strain, and whether the dynamics had to find it.

    Raises:
        ArithmeticError: no equilibrium was found within `choices.max_steps` steps of the dynamics.
        PackingError: the box is too small to be sheared so far.
    """
    affine = strained_affinely(before, strain, choices.loaded)
    if choices.relaxation == "newton":
        tolerance = choices.force_tolerance
        found = find_equilibrium(
            affine, before.interaction, tolerance, before, max_released_force=tolerance
        )
        if found is not None and not found.unstable:
            return found, False
    return _equilibrium_by_dynamics(affine, before, choices), True


def strained_affinely(before: EquilibriumState, strain: float, loaded: bool) -> Packing:
    """The packing of an equilibrium at another strain, before it relaxes.

    If `loaded`, the affine motion also stretches the tangential springs.

    Raises:
        PackingError: the box is too small to be sheared so far.
    """
    sheared = before.packing.sheared(strain)
    if not loaded or is_frictionless(before.interaction):
        return sheared
    contacts = before.packing.contacts
    r = contacts.normal * contacts.distance[:, None]
    slide = (strain - before.packing.strain) * r[:, 1]
    middle = np.hypot(r[:, 0] + 0.5 * slide, r[:, 1])
    overlap = contacts.overlap + contacts.distance - middle
    s = advance_by_slide(before.interaction, overlap, contacts.springs, slide * r[:, 1] / middle)
    return replace(sheared, history=History(contacts.i, contacts.j, s))


def _equilibrium_by_dynamics(
    packing: Packing, before: EquilibriumState, choices: Shear
) -> EquilibriumState:
    """Dynamics into the basin of an equilibrium, then Newton's method to its bottom.

    Where Newton's method fails, the dynamics goes on to ever smaller forces, in the end to F_Th.
    Damped relaxation, as B does it, goes to F_Th at once.
    """
    interaction, target = before.interaction, choices.force_tolerance
    tolerance, steps_left = target, choices.max_steps
    if choices.relaxation != "damped":
        mean = mean_contact_force(packing, interaction)
        tolerance = max(HANDOVER_FORCE_RATIO * mean, target)
    while steps_left > 0:
        relaxed = _run_dynamics(packing, interaction, tolerance, choices, steps_left)
        is_last = tolerance <= target
        max_released_force = np.inf if is_last else target
        found = find_equilibrium(relaxed.packing, interaction, target, before, max_released_force)
        if found is not None and not found.unstable:
            return found
        if is_last:
            break
        packing, steps_left = relaxed.packing, steps_left - relaxed.iterations
        tolerance = max(HANDOVER_REDUCTION * tolerance, target)
    raise ArithmeticError(
        f"strain {packing.strain}: no stable equilibrium, max|F| = {relaxed.max_force:.1e} after "
        f"{choices.max_steps - steps_left + relaxed.iterations} steps of the dynamics"
    )


def _run_dynamics(
    packing: Packing, interaction: Interaction, tolerance: float, choices: Shear, max_steps: int
) -> RelaxationResult:
    """Relax until max|F̃| < `tolerance`: by B's damped dynamics, without friction by FIRE."""
    if is_frictionless(interaction):
        return relax_fire_newton(packing, interaction.normal, tolerance, max_steps)
    damping = Drag(choices.drag)
    return relax_damped(packing, interaction, damping, choices.time_step, tolerance, max_steps)
