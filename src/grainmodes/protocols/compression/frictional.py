"""States compressed with friction, whose springs are loaded: A, footnote 1.

A packing is loosened affinely until nothing touches, at φ_0, and pressed back to its φ with the
frictional law, from one balance of damped dynamics, A (1)–(9), to the next:

    φ_k = φ_0 + k (φ − φ_0)/n,   k = 1 … n

so that s ≠ 0 in its contacts, and J is not symmetric. Newton's method ends it at max|F̃| < F_Th.
One step would lead back to the packing as it was, with s = 0: only many steps of φ, however near
φ_0 lies to φ, let contacts close one after the other.

Which state is reached, and so its number of complex pairs of M⁻¹J, depends on every choice below;
that there are some hardly does. 16 samples, N = 64, k_T = k_N:

| n, balance, longest | φ = 0.90: with pairs, mean number | φ = 0.84: of 15 jammed |
| ------------------- | --------------------------------- | ---------------------- |
| 10, 1e-3, 20 000    | 16, 6.4                           | 14, 5.7                |
| 20, 1e-3, 20 000    | 16, 5.0                           | 15, 5.4                |
| 40, 1e-3, 20 000    | 16, 5.3                           | 15, 4.6                |
| 20, 1e-4, 20 000    | 16, 5.1                           |                        |
| 20, 1e-2, 20 000    | 16, 4.8                           | 15, 5.5                |
| 20, 1e-2, 10 000    | 15, 4.5                           |                        |

The choice below, the last but one, costs 2.5e5 time steps at φ = 0.90 for k_T = k_N, and its bound
of 8e5 for k_T = 1e-8 k_N.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from grainmodes.kernels.damping import Dashpot
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import rattlers
from grainmodes.packing.forces import mean_contact_force
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.result import Relaxed

STEPS = 20
"""Steps n of φ: more change the numbers of pairs no further than another sample would."""

BALANCE = 1e-2
"""max|F̃| after a step, relative to the mean contact force before it."""

BASIN = 1e-6
"""The same before Newton's method."""

LONGEST = 20_000
"""Time steps after a step of φ, at most: loose grains and weak springs creep for ever."""

TIME_STEP = 1e-2
"""Δt of A, in t_0."""

VISCOSITY = 1.0
"""η_D of A."""

LOOSE = 1
"""With friction a grain holds on two contacts: a rattler has one at most."""

NEWTON_ITERATIONS = 40
"""As many as after a step strain."""


@dataclass(frozen=True)
class Compressed:
    """The backbone of a state compressed with friction, in balance; empty where it is not jammed.

    `steps` counts the time steps of the dynamics.
    """

    packing: Packing
    jammed: bool
    steps: int


def frictional_compression(
    packing: Packing, interaction: Interaction, tolerance: float
) -> Compressed:
    """Loosen a packing and compress it again with friction, down to max|F̃| < `tolerance`.

    Raises:
        ArithmeticError: a rigid backbone did not reach its balance.
    """
    now, steps = loosened(packing), 0
    for phi in np.linspace(now.phi, packing.phi, STEPS + 1)[1:]:
        relaxed = _damped(now.at(float(phi)), interaction, BALANCE, LONGEST)
        now, steps = relaxed.packing, steps + relaxed.iterations
    relaxed = _damped(now, interaction, BASIN, STEPS * LONGEST)
    return _balanced(relaxed.packing, interaction, tolerance, steps + relaxed.iterations)


def loosened(packing: Packing) -> Packing:
    """The same fractions in the largest box in which a pair touches, without springs."""
    contacts = find_contacts(packing)
    stretch = 1.0 + contacts.overlap / contacts.distance
    length = packing.box_length * stretch.max(initial=1.0)
    return replace(packing, box_length=float(length), rotation=None, history=None)


def _damped(packing: Packing, interaction: Interaction, balance: float, longest: int) -> Relaxed:
    """Damped dynamics until the forces are a small part `balance` of the mean contact force."""
    force = mean_contact_force(find_contacts(packing), interaction)
    damping = Dashpot(VISCOSITY)
    return relax_damped(packing, interaction, damping, TIME_STEP, balance * force, longest)


def _balanced(
    packing: Packing, interaction: Interaction, tolerance: float, steps: int
) -> Compressed:
    """The backbone in its final balance."""
    backbone = packing.without(rattlers(find_contacts(packing), packing.n, LOOSE))
    if not _may_be_rigid(backbone):
        return Compressed(backbone.without(np.ones(backbone.n, bool)), False, steps)
    solved = newton(backbone, interaction, tolerance, NEWTON_ITERATIONS)
    if not solved.converged:
        raise ArithmeticError(
            f"compressed with friction: max|F| = {solved.max_force:.1e}, max|2T/d| = "
            f"{solved.max_torque:.1e} after {steps} time steps and {solved.iterations} iterations"
        )
    return Compressed(solved.packing, True, steps)


def _may_be_rigid(backbone: Packing) -> bool:
    """Two force components a contact hold three degrees of freedom a grain, and a pressure."""
    return 2 * len(find_contacts(backbone).i) >= 3 * backbone.n - 1 > 0
