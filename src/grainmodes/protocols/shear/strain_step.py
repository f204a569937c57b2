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
from functools import partial

import numpy as np

from grainmodes.kernels.damping import Drag
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_by_slide
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import is_frictionless
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.relaxation.dynamic_equilibrium import (
    HANDOVER_FORCE_RATIO,
    equilibrium_by_dynamics,
)
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.equilibrium_search import find_equilibrium
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.relaxation.frictionless import relax_fire_newton
from grainmodes.relaxation.result import RelaxationResult


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
    """The equilibrium that the dynamics leads to; damped relaxation, as B does it, ends there."""
    interaction, damped = before.interaction, choices.relaxation == "damped"
    found, _ = equilibrium_by_dynamics(
        packing,
        interaction,
        partial(_run_dynamics, interaction, choices),
        choices.force_tolerance,
        choices.max_steps,
        before,
        handover=0.0 if damped else HANDOVER_FORCE_RATIO,
    )
    return found


def _run_dynamics(
    interaction: Interaction, choices: Shear, packing: Packing, tolerance: float, max_steps: int
) -> RelaxationResult:
    """Relax until max|F̃| < `tolerance`: by B's damped dynamics, without friction by FIRE."""
    if is_frictionless(interaction):
        return relax_fire_newton(packing, interaction.normal, tolerance, max_steps)
    damping = Drag(choices.drag)
    return relax_damped(packing, interaction, damping, choices.time_step, tolerance, max_steps)
