"""The simulated rigidity: a step strain, relaxed by the full non-linear forces. A, Sec. II.

    r_i → r_i + Δγ (y_i, 0)      affine, without loading the tangential springs
    g_forward = [σ_xy(Δγ) − σ_xy(0)] / Δγ                                A (14)–(16)
    g = [σ_xy(Δγ) − σ_xy(−Δγ)] / 2Δγ

A's forward difference is off by g' Δγ/2, which at Δγ = 1e-6 is 1e-3 of g for a packing with a soft
mode; the step to both sides leaves an error of second order. Both are reported.

In fractional coordinates the affine jump is a change of γ alone. Rattlers are taken out first: they
carry no load, and one that is left touching would relax for millions of steps without moving g.
Newton's method and damped dynamics relax the same forces; they end in the same state as long as no
contact opens or closes on the way.
"""

from __future__ import annotations

from dataclasses import dataclass

from grainmodes.forces import is_frictionless, stress
from grainmodes.kernels.dynamics import Dashpot
from grainmodes.kernels.laws import Interaction
from grainmodes.packing import Contacts, Packing, find_contacts, rattlers
from grainmodes.parameters import StepStrain
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.result import Relaxed

NEWTON_ITERATIONS = 40
"""Contacts that open or close near zero overlap make Newton linear, ξ → ξ/3 a step."""


@dataclass(frozen=True)
class Simulated:
    """g of relaxed step strains, k_N d^(1/2), and how the worse of the two went."""

    g: float
    g_forward: float
    converged: bool
    iterations: int
    max_force: float
    max_torque: float
    contact_changes: int


def step_strain(
    packing: Packing, interaction: Interaction, protocol: StepStrain, threshold: int = 2
) -> Simulated:
    """Strain a packing in force balance by ± `protocol.strain` and relax it.

    Raises:
        ValueError: damped relaxation of a frictionless packing (rotation does not exist there).
    """
    gone = rattlers(find_contacts(packing), packing.n, threshold)
    backbone = packing.without(gone) if gone.any() else packing
    before = find_contacts(backbone)
    at_rest = stress(backbone, before, interaction)[0, 1]
    steps = [
        _relaxed(backbone.sheared(backbone.strain + step), interaction, protocol)
        for step in (protocol.strain, -protocol.strain)
    ]
    after = [find_contacts(step.packing) for step in steps]
    forward, backward = (
        stress(step.packing, contacts, interaction)[0, 1]
        for step, contacts in zip(steps, after, strict=True)
    )
    return Simulated(
        float((forward - backward) / (2.0 * protocol.strain)),
        float((forward - at_rest) / protocol.strain),
        all(step.converged for step in steps),
        sum(step.iterations for step in steps),
        max(step.max_force for step in steps),
        max(step.max_torque for step in steps),
        max(changes(before, contacts) for contacts in after),
    )


def _relaxed(packing: Packing, interaction: Interaction, protocol: StepStrain) -> Relaxed:
    if protocol.relaxation == "newton":
        return newton(packing, interaction, protocol.force_tolerance, NEWTON_ITERATIONS)
    if is_frictionless(interaction):
        raise ValueError("damped relaxation of a frictionless packing: use relaxation = newton")
    return relax_damped(
        packing,
        interaction,
        Dashpot(protocol.damping),
        protocol.time_step,
        protocol.force_tolerance,
        protocol.max_steps,
    )


def changes(before: Contacts, after: Contacts) -> int:
    """Contacts that are in one list but not in the other."""
    pairs = [set(zip(c.i.tolist(), c.j.tolist(), strict=True)) for c in (before, after)]
    return len(pairs[0] ^ pairs[1])
