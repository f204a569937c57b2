"""One step of athermal quasistatic shear: affine, then relaxed to the balance it leads to. B, Sec. II.

    r_i → r_i + Δγ (y_i, 0),   then J u = F̃ until max|F̃| < F_Th

The affine step leaves the tangential springs alone (`unloaded`, B), or stretches them along as
continuous shear would (`loaded`): s → s + Δγ t·(r_y, 0), t at the middle of the step.

Which balance a step leads to is defined by B's damped dynamics, q̈ = M⁻¹F̃ − η q̇ from the affine
state. Newton's method finds the same one as long as the balance merely moves. Where it does not
converge, where it ends on a saddle, or where the balance it finds lies farther off than `FAR`
elastic steps, the dynamics decides, and Newton only sharpens the end.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from grainmodes.forces import is_frictionless, mean_contact_force
from grainmodes.kernels.damping import Drag
from grainmodes.kernels.laws import Interaction
from grainmodes.packing import History, Packing, find_contacts
from grainmodes.parameters.protocol import Shear
from grainmodes.relaxation.balance import Balance, find_balance
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.frictionless import relax_fast

BASIN = 1e-6
"""max|F̃|, relative to the mean contact force, at which dynamics hands over to Newton's method."""

NEWTON, DYNAMICS = 0, 1
"""How a balance was found."""


@dataclass(frozen=True)
class Step:
    """The balance after a step, and how it was found: `NEWTON` or `DYNAMICS`."""

    balance: Balance
    how: int


def balance_of(packing: Packing, interaction: Interaction, choices: Shear) -> Balance:
    """The balance of a packing that is in balance already, or nearly.

    Raises:
        ArithmeticError: there is none nearby.
    """
    found = find_balance(packing, interaction, choices.force_tolerance)
    if found is None:
        raise ArithmeticError(f"no force balance near the packing at strain {packing.strain}")
    return found


def step_to(strain: float, before: Balance, choices: Shear) -> Step:
    """The balance at another strain.

    Raises:
        ArithmeticError: none was found within `choices.max_steps` of the dynamics.
        PackingError: the box is too small to be sheared so far.
    """
    affine = affinely(before, strain, choices.loaded)
    if choices.relaxation == "newton":
        found = find_balance(affine, before.interaction, choices.force_tolerance, before)
        if found is not None and not found.unstable:
            return Step(found, NEWTON)
    return Step(_by_dynamics(affine, before.interaction, choices), DYNAMICS)


def affinely(before: Balance, strain: float, loaded: bool) -> Packing:
    """The affine step, its springs stretched along or not."""
    sheared = before.packing.sheared(strain)
    if not loaded or is_frictionless(before.interaction):
        return sheared
    contacts = before.contacts
    r = contacts.normal * contacts.distance[:, None]
    slide = (strain - before.packing.strain) * r[:, 1]
    middle = np.stack([r[:, 0] + 0.5 * slide, r[:, 1]])
    s = contacts.displacement + slide * middle[1] / np.hypot(*middle)
    return replace(sheared, history=History(contacts.i, contacts.j, s))


def _by_dynamics(packing: Packing, interaction: Interaction, choices: Shear) -> Balance:
    """Damped dynamics into a basin, Newton's method to its bottom; deeper in if that leaves it."""
    scale = mean_contact_force(find_contacts(packing), interaction)
    tolerance, left = max(BASIN * scale, choices.force_tolerance), choices.max_steps
    while left > 0:
        if choices.relaxation == "damped":
            tolerance = choices.force_tolerance
        relaxed = _relaxed(packing, interaction, tolerance, choices, left)
        found = find_balance(relaxed.packing, interaction, choices.force_tolerance)
        if found is not None and not found.unstable:
            return found
        packing, left = relaxed.packing, left - relaxed.iterations
        tolerance *= 0.01
        if tolerance < choices.force_tolerance:
            break
    raise ArithmeticError(f"strain {packing.strain}: no balance after {choices.max_steps} steps")


def _relaxed(packing: Packing, interaction, tolerance: float, choices: Shear, steps: int):
    if is_frictionless(interaction):
        return relax_fast(packing, interaction.normal, tolerance, steps)
    damping = Drag(choices.drag)
    return relax_damped(packing, interaction, damping, choices.time_step, tolerance, steps)
