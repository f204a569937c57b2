"""One step of athermal quasistatic shear: affine, then relaxed to the balance it leads to: B.

    r_i → r_i + Δγ (y_i, 0),   then J u = F̃ until max|F̃| < F_Th

The affine step leaves the tangential springs alone (`unloaded`, B), or stretches them along as
continuous shear would (`loaded`): s → s + Δγ t·(r_y, 0), t at the middle of the step.

Which balance a step leads to is defined by B's damped dynamics, q̈ = M⁻¹F̃ − η q̇ from the affine
state. Newton's method finds the same one as long as the balance moves on continuously. It does not
decide

- where it finds no balance, or a saddle of J;
- where a contact opens that still bears a tangential force. A harmonic contact without slip bears
  k_T s at zero overlap and lets go of it at once; it may close again with s = 0, and where it does
  depends on the path.

There the dynamics decides and Newton only sharpens the end.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainmodes.kernels.damping import Drag
from grainmodes.kernels.laws import Interaction
from grainmodes.kernels.springs import advance_by_slide
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import is_frictionless, mean_contact_force
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.parameters.strain import Shear
from grainmodes.relaxation.balance import Balance
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.following import find_balance
from grainmodes.relaxation.frictionless import relax_fast
from grainmodes.relaxation.result import Relaxed

BASIN = 1e-4
"""max|F̃|, relative to the mean contact force, at which dynamics hands over to Newton's method: by
then it has decided which contacts open and close (docs/numerics.md)."""

DEEPER = 0.1
"""Factor on that where Newton's method leaves the basin."""


def first_balance(packing: Packing, interaction: Interaction, choices: Shear) -> Balance:
    """The balance of a packing that is in balance already, or nearly.

    Raises:
        ArithmeticError: there is none nearby.
    """
    found = find_balance(packing, interaction, choices.force_tolerance)
    if found is None or found.unstable:
        raise ArithmeticError(f"no stable balance near the packing at strain {packing.strain}")
    return found


def step_to(strain: float, before: Balance, choices: Shear) -> tuple[Balance, bool]:
    """The balance at another strain, and whether the dynamics had to decide on it.

    Raises:
        ArithmeticError: none was found within `choices.max_steps` of the dynamics.
        PackingError: the box is too small to be sheared so far.
    """
    affine = affinely(before, strain, choices.loaded)
    if choices.relaxation == "newton":
        tolerance = choices.force_tolerance
        found = find_balance(affine, before.interaction, tolerance, before, most_lost=tolerance)
        if found is not None and not found.unstable:
            return found, False
    return _by_dynamics(affine, before, choices), True


def affinely(before: Balance, strain: float, loaded: bool) -> Packing:
    """The affine step, its springs stretched along or not."""
    sheared = before.packing.sheared(strain)
    if not loaded or is_frictionless(before.interaction):
        return sheared
    contacts = before.contacts
    r = contacts.normal * contacts.distance[:, None]
    slide = (strain - before.packing.strain) * r[:, 1]
    middle = np.hypot(r[:, 0] + 0.5 * slide, r[:, 1])
    overlap = contacts.overlap + contacts.distance - middle
    s = advance_by_slide(
        before.interaction, overlap, contacts.displacement, slide * r[:, 1] / middle
    )
    return replace(sheared, history=History(contacts.i, contacts.j, s))


def _by_dynamics(packing: Packing, before: Balance, choices: Shear) -> Balance:
    """Dynamics into a basin, Newton's method to its bottom; deeper in if that fails."""
    interaction = before.interaction
    tolerance, left = _handover(packing, interaction, choices), choices.max_steps
    while left > 0:
        relaxed = _relaxed(packing, interaction, tolerance, choices, left)
        to_the_end = tolerance <= choices.force_tolerance
        most_lost = np.inf if to_the_end else choices.force_tolerance
        found = find_balance(
            relaxed.packing, interaction, choices.force_tolerance, before, most_lost
        )
        if found is not None and not found.unstable:
            return found
        if to_the_end:
            break
        packing, left = relaxed.packing, left - relaxed.iterations
        tolerance = max(DEEPER * tolerance, choices.force_tolerance)
    raise ArithmeticError(
        f"strain {packing.strain}: no stable balance, max|F| = {relaxed.max_force:.1e} after "
        f"{choices.max_steps - left + relaxed.iterations} steps of the dynamics"
    )


def _handover(packing: Packing, interaction: Interaction, choices: Shear) -> float:
    """max|F̃| at which the dynamics stops: B's own F_Th where nothing else is to relax."""
    if choices.relaxation == "damped":
        return choices.force_tolerance
    mean = mean_contact_force(find_contacts(packing), interaction)
    return max(BASIN * mean, choices.force_tolerance)


def _relaxed(
    packing: Packing, interaction, tolerance: float, choices: Shear, steps: int
) -> Relaxed:
    if is_frictionless(interaction):
        return relax_fast(packing, interaction.normal, tolerance, steps)
    damping = Drag(choices.drag)
    return relax_damped(packing, interaction, damping, choices.time_step, tolerance, steps)
