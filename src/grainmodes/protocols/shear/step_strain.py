"""The rigidity of a simulated step strain, relaxed by the full non-linear forces: A, Sec. II.

    r_i → r_i + Δγ (y_i, 0)      affine, without loading the tangential springs
    g_forward = [σ_xy(Δγ) − σ_xy(0)] / Δγ                                A (14)–(16)
    g = [σ_xy(Δγ) − σ_xy(−Δγ)] / 2Δγ

A's forward difference at Δγ = 1e-6 is wrong by g'Δγ/2, which reaches 5 % of g for a packing with a
soft mode. The central difference leaves an error of second order. Δγ is divided by ten until two
sizes agree to 1e-6, and the difference that is left is the stated error. Both g are reported.

In fractional coordinates the affine strain is a change of γ alone. Rattlers are removed first: they
carry no load, and a rattler that still touches would relax for millions of steps without changing
g. Newton's method and damped dynamics relax the same forces. They end in the same state as long as
no contact opens or closes on the way.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from grainmodes.kernels.damping import Dashpot
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import contact_changes
from grainmodes.packing.forces import is_frictionless, stress
from grainmodes.packing.state import Packing, backbone
from grainmodes.parameters.strain import StepStrain
from grainmodes.relaxation.dynamics import relax_damped
from grainmodes.relaxation.newton import newton
from grainmodes.relaxation.result import RelaxationResult

MAX_NEWTON_ITERATIONS = 40
"""Contacts that open or close near zero overlap make Newton's method linear, ξ → ξ/3 a step."""

SUFFICIENT_AGREEMENT = 1e-6
"""Relative difference of g at two sizes of the step below which the larger size was small enough.
"""

MIN_STRAIN = 1e-9
"""Below this the rounding of the stress, 1e-16 σ/Δγ, outgrows what a smaller step gains."""


@dataclass(frozen=True)
class SimulatedRigidity:
    """g of relaxed step strains, in k_N d^(1/2), with the worst relaxation behind it.

    `error` is the difference to g of the step ten times larger, `strain` the size of the step, and
    `contact_changes` the number of contacts that it opened or closed. Forces are in k_N d^(3/2).
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
) -> SimulatedRigidity:
    """g of a packing in force balance, from steps ±Δγ, the first of size `protocol.strain`.

    Args:
        threshold: most contacts of a rattler.

    Raises:
        ValueError: damped relaxation of a frictionless packing, in which rotation does not exist.
    """
    core = backbone(packing, threshold)
    larger = _central_difference(core, interaction, protocol)
    g_forward, best = larger.g_forward, larger
    while best.error > SUFFICIENT_AGREEMENT * abs(best.g) and larger.strain >= 9.9 * MIN_STRAIN:
        size = 0.1 * larger.strain
        smaller = _central_difference(core, interaction, replace(protocol, strain=size))
        smaller = replace(smaller, error=abs(smaller.g - larger.g))
        best = min(best, smaller, key=lambda result: result.error)
        larger = smaller
    return replace(best, g_forward=g_forward)


def forward_rigidity(
    packing: Packing, interaction: Interaction, protocol: StepStrain, threshold: int = 2
) -> float:
    """g of one forward step of size `protocol.strain`, in k_N d^(1/2): A (14)–(16).

    Raises:
        ArithmeticError: the strained packing did not reach its balance.
        ValueError: as `step_strain`.
    """
    before = backbone(packing, threshold)
    after = _relax(before.sheared(before.strain + protocol.strain), interaction, protocol)
    if not after.converged:
        raise ArithmeticError(unbalanced(after, protocol))
    at_rest, strained = (stress(state, interaction)[0, 1] for state in (before, after.packing))
    return float((strained - at_rest) / protocol.strain)


def _central_difference(
    packing: Packing, interaction: Interaction, protocol: StepStrain
) -> SimulatedRigidity:
    """g of steps ±Δγ of one size; its error is not yet known."""
    at_rest = stress(packing, interaction)[0, 1]
    relaxed = relaxed_steps(packing, interaction, protocol)
    forward, backward = (stress(step.packing, interaction)[0, 1] for step in relaxed)
    return SimulatedRigidity(
        g=float((forward - backward) / (2.0 * protocol.strain)),
        g_forward=float((forward - at_rest) / protocol.strain),
        error=float("inf"),
        strain=protocol.strain,
        converged=all(step.converged for step in relaxed),
        iterations=sum(step.iterations for step in relaxed),
        max_force=max(step.max_force for step in relaxed),
        max_torque=max(step.max_torque for step in relaxed),
        contact_changes=max(
            contact_changes(packing.contacts, step.packing.contacts) for step in relaxed
        ),
    )


def relaxed_steps(
    packing: Packing, interaction: Interaction, protocol: StepStrain
) -> tuple[RelaxationResult, RelaxationResult]:
    """A packing without rattlers after the steps Δγ and −Δγ, each relaxed.

    Raises:
        ValueError: as `step_strain`.
    """
    forward, backward = (
        _relax(packing.sheared(packing.strain + step), interaction, protocol)
        for step in (protocol.strain, -protocol.strain)
    )
    return forward, backward


def unbalanced(relaxed: RelaxationResult, protocol: StepStrain) -> str:
    """The sentence that says why a relaxation did not end in balance."""
    return (
        f"step strain {protocol.strain}: expected max|F| and max|2T/d| < "
        f"{protocol.force_tolerance:.1e}, got {relaxed.max_force:.1e} and "
        f"{relaxed.max_torque:.1e} after {relaxed.iterations} iterations"
    )


def _relax(packing: Packing, interaction: Interaction, protocol: StepStrain) -> RelaxationResult:
    if protocol.relaxation == "newton":
        return newton(packing, interaction, protocol.force_tolerance, MAX_NEWTON_ITERATIONS)
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
