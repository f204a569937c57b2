"""The simulated rigidity: a step strain, relaxed by the full non-linear forces. A, Sec. II.

    r_i → r_i + Δγ (y_i, 0)      affine, without loading the tangential springs
    g_forward = [σ_xy(Δγ) − σ_xy(0)] / Δγ                                A (14)–(16)
    g = [σ_xy(Δγ) − σ_xy(−Δγ)] / 2Δγ

A's forward difference at Δγ = 1e-6 is off by g'Δγ/2, which reaches 5 % of g for a packing with a
soft mode. Stepping to both sides leaves an error of second order, and Δγ is divided by ten until
two sizes agree to 1e-6; what they still differ by is the stated error. Both g are reported.

In fractional coordinates the affine jump is a change of γ alone. Rattlers are taken out first: they
carry no load, and one that is left touching would relax for millions of steps without moving g.
Newton's method and damped dynamics relax the same forces; they end in the same state as long as no
contact opens or closes on the way.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from grainmodes.kernels.damping import Dashpot
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts, rattlers
from grainmodes.packing.forces import is_frictionless, stress
from grainmodes.packing.state import Packing, find_contacts
from grainmodes.parameters.strain import StepStrain
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.result import Relaxed

NEWTON_ITERATIONS = 40
"""Contacts that open or close near zero overlap make Newton linear, ξ → ξ/3 a step."""

AGREEMENT = 1e-6
"""Relative difference of g at two sizes of the step at which the larger one was small enough."""

SMALLEST_STRAIN = 1e-9
"""Below this the rounding of the stress, 1e-16 σ/Δγ, outgrows what a smaller step gains."""


@dataclass(frozen=True)
class Simulated:
    """g of relaxed step strains, k_N d^(1/2), and how the worst relaxation behind it went.

    `error` is the difference to the g of the step ten times larger, `strain` the size of the step,
    `contact_changes` counts contacts opened or closed by it.
    """

    g: float
    g_forward: float
    error: float
    strain: float
    converged: bool
    iterations: int
    max_force: float
    max_torque: float
    contact_changes: int


def step_strain(
    packing: Packing, interaction: Interaction, protocol: StepStrain, threshold: int = 2
) -> Simulated:
    """Strain a packing in force balance by ±Δγ, first `protocol.strain`, and relax it.

    Raises:
        ValueError: damped relaxation of a frictionless packing (rotation does not exist there).
    """
    backbone = _backbone(packing, threshold)
    larger = _both_sides(backbone, interaction, protocol)
    g_forward, best = larger.g_forward, larger
    while best.error > AGREEMENT * abs(best.g) and larger.strain >= 9.9 * SMALLEST_STRAIN:
        size = 0.1 * larger.strain
        smaller = _both_sides(backbone, interaction, replace(protocol, strain=size))
        smaller = replace(smaller, error=abs(smaller.g - larger.g))
        best = min(best, smaller, key=lambda result: result.error)
        larger = smaller
    return replace(best, g_forward=g_forward)


def forward_rigidity(
    packing: Packing, interaction: Interaction, protocol: StepStrain, threshold: int = 2
) -> float:
    """g of one forward step `protocol.strain`, whatever its error, k_N d^(1/2): A (14)–(16).

    Raises:
        ArithmeticError: the strained packing did not reach its balance.
        ValueError: as `step_strain`.
    """
    before = _backbone(packing, threshold)
    after = _relaxed(before.sheared(before.strain + protocol.strain), interaction, protocol)
    if not after.converged:
        raise ArithmeticError(f"max|F| = {after.max_force:.1e}, {after.iterations} iterations")
    at_rest, strained = (
        stress(state, find_contacts(state), interaction)[0, 1] for state in (before, after.packing)
    )
    return float((strained - at_rest) / protocol.strain)


def _backbone(packing: Packing, threshold: int) -> Packing:
    gone = rattlers(find_contacts(packing), packing.n, threshold)
    return packing.without(gone) if gone.any() else packing


def _both_sides(packing: Packing, interaction: Interaction, protocol: StepStrain) -> Simulated:
    """Steps of ±Δγ, each relaxed; the error is not yet known."""
    before = find_contacts(packing)
    at_rest = stress(packing, before, interaction)[0, 1]
    steps = relaxed_steps(packing, interaction, protocol)
    after = [find_contacts(step.packing) for step in steps]
    forward, backward = (
        stress(step.packing, contacts, interaction)[0, 1]
        for step, contacts in zip(steps, after, strict=True)
    )
    return Simulated(
        float((forward - backward) / (2.0 * protocol.strain)),
        float((forward - at_rest) / protocol.strain),
        float("inf"),
        protocol.strain,
        all(step.converged for step in steps),
        sum(step.iterations for step in steps),
        max(step.max_force for step in steps),
        max(step.max_torque for step in steps),
        max(changes(before, contacts) for contacts in after),
    )


def relaxed_steps(
    packing: Packing, interaction: Interaction, protocol: StepStrain
) -> tuple[Relaxed, Relaxed]:
    """A packing without rattlers after steps of Δγ and −Δγ, each relaxed.

    Raises:
        ValueError: damped relaxation of a frictionless packing (rotation does not exist there).
    """
    forward, backward = (
        _relaxed(packing.sheared(packing.strain + step), interaction, protocol)
        for step in (protocol.strain, -protocol.strain)
    )
    return forward, backward


def _relaxed(packing: Packing, interaction: Interaction, protocol: StepStrain) -> Relaxed:
    if protocol.relaxation == "newton":
        return newton(packing, interaction, protocol.force_tolerance, NEWTON_ITERATIONS)
    if is_frictionless(interaction):
        raise ValueError("relaxation: expected newton for a frictionless packing, got damped")
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
