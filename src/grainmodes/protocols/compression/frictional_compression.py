"""States compressed with friction, whose springs are loaded: A, footnote 1.

A packing is expanded affinely until no two grains touch, at φ_0. Then it is compressed back to its
φ with the frictional law, by damped dynamics, A (1)–(9), from one balance to the next:

    φ_k = φ_0 + k (φ − φ_0)/n,   k = 1 … n

so that s ≠ 0 in its contacts, and J is not symmetric. In the end Newton's method refines the
balance to max|F̃| < F_Th. A single step would lead back to the original packing, with s = 0: only
many steps of φ, however near φ_0 lies to φ, let contacts close one after the other.

Which state is reached, and so its number of complex pairs of M⁻¹J, depends on every choice below.
Whether there are pairs at all hardly depends on them. 16 samples, N = 64, k_T = k_N:

| n, force ratio, most steps | φ = 0.90: with pairs, mean number | φ = 0.84: of 15 jammed |
| -------------------------- | --------------------------------- | ---------------------- |
| 10, 1e-3, 20 000           | 16, 6.4                           | 14, 5.7                |
| 20, 1e-3, 20 000           | 16, 5.0                           | 15, 5.4                |
| 40, 1e-3, 20 000           | 16, 5.3                           | 15, 4.6                |
| 20, 1e-4, 20 000           | 16, 5.1                           |                        |
| 20, 1e-2, 20 000           | 16, 4.8                           | 15, 5.5                |
| 20, 1e-2, 10 000           | 15, 4.5                           |                        |

The constants below are the last line but one. A compression then takes 2.5e5 time steps at
φ = 0.90 for k_T = k_N, and its upper bound of 8e5 for k_T = 1e-8 k_N.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from grainmodes.kernels.damping import Dashpot
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import mean_contact_force
from grainmodes.packing.state import Packing, rattlers
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.result import RelaxationResult

PHI_STEPS = 20
"""Steps n of φ: more of them change the number of pairs no more than another sample would."""

STEP_FORCE_RATIO = 1e-2
"""max|F̃| after a step of φ, relative to the mean contact force before it."""

NEWTON_FORCE_RATIO = 1e-6
"""max|F̃| at which Newton's method takes over, relative to the mean contact force."""

MAX_TIME_STEPS = 20_000
"""Time steps after one step of φ, at most: rattlers and weak springs would creep for ever."""

TIME_STEP = 1e-2
"""Δt of A, in t_0."""

VISCOSITY = 1.0
"""η_D of A."""

RATTLER_CONTACTS = 1
"""Most contacts of a rattler: with friction two contacts can hold a grain."""

MAX_NEWTON_ITERATIONS = 40
"""Iterations of Newton's method, as many as after a step strain."""


@dataclass(frozen=True)
class CompressedState:
    """The backbone of a packing compressed with friction, in balance; empty if it is not jammed.

    `steps` is the number of time steps of the dynamics.
    """

    packing: Packing
    jammed: bool
    steps: int


def frictional_compression(
    packing: Packing, interaction: Interaction, tolerance: float
) -> CompressedState:
    """Expand a packing and compress it again with friction, until max|F̃| < `tolerance`.

    `tolerance` is in k_N d^(3/2).

    Raises:
        ArithmeticError: a rigid backbone did not reach its balance.
    """
    current, steps = expanded_to_contact(packing), 0
    for phi in np.linspace(current.phi, packing.phi, PHI_STEPS + 1)[1:]:
        compressed = current.at(float(phi))
        relaxed = _relax(compressed, interaction, STEP_FORCE_RATIO, MAX_TIME_STEPS)
        current, steps = relaxed.packing, steps + relaxed.iterations
    relaxed = _relax(current, interaction, NEWTON_FORCE_RATIO, PHI_STEPS * MAX_TIME_STEPS)
    return _final_balance(relaxed.packing, interaction, tolerance, steps + relaxed.iterations)


def expanded_to_contact(packing: Packing) -> Packing:
    """The packing in the largest box in which two grains still touch, without springs."""
    contacts = packing.contacts
    stretch = 1.0 + contacts.overlap / contacts.distance
    length = packing.box_length * stretch.max(initial=1.0)
    return replace(packing, box_length=float(length), rotation=None, history=None)


def _relax(
    packing: Packing, interaction: Interaction, force_ratio: float, max_steps: int
) -> RelaxationResult:
    """Damped dynamics until max|F̃| is the part `force_ratio` of the mean contact force."""
    force = mean_contact_force(packing, interaction)
    damping = Dashpot(VISCOSITY)
    return relax_damped(packing, interaction, damping, TIME_STEP, force_ratio * force, max_steps)


def _final_balance(
    packing: Packing, interaction: Interaction, tolerance: float, steps: int
) -> CompressedState:
    """The backbone in its final balance, if it may be rigid.

    Each contact has two force components, each grain three degrees of freedom: a rigid backbone
    under pressure has at least 2C ≥ 3N − 1.
    """
    backbone = packing.without(rattlers(packing, RATTLER_CONTACTS))
    if not 2 * len(backbone.contacts.i) >= 3 * backbone.n - 1 > 0:
        return CompressedState(backbone.without(np.ones(backbone.n, bool)), False, steps)
    solved = newton(backbone, interaction, tolerance, MAX_NEWTON_ITERATIONS)
    if not solved.converged:
        raise ArithmeticError(
            f"frictional compression: expected max|F| and max|2T/d| < {tolerance:.1e}, got "
            f"{solved.max_force:.1e} and {solved.max_torque:.1e} after {steps} time steps and "
            f"{solved.iterations} iterations"
        )
    return CompressedState(solved.packing, True, steps)
