"""Δγ of a simulated rigidity: truncation, a plateau, round-off. A, Sec. II.

    g_forward = [σ_xy(Δγ) − σ_xy(0)] / Δγ = g + g' Δγ/2 + …               A (14)–(16)
    g_both    = [σ_xy(Δγ) − σ_xy(−Δγ)] / 2Δγ = g + O(Δγ²)

The larger Δγ, the larger is the truncation error, and the sooner a contact opens or closes; the
smaller Δγ, the larger are the errors of the residual forces, about F_Th / Δγ, and of the rounding
of σ, 1e-16 σ / Δγ. A claims a
plateau, no dependence on Δγ for 1e-6 … 1e-4. A relaxes by damped dynamics, here Newton's method
does, which overshoots its F_Th: the last step squares the error. The default rule starts at Δγ and
divides it by ten until two sizes agree to 1e-6 (`protocols.shear.step_strain`).

Reference: g by linear response, one solve with J in the same state (`rigidity`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import stress
from grainmodes.packing.state import Packing, backbone
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain import forward_rigidity, relaxed_steps, step_strain
from grainmodes.response.moduli import rigidity
from grainmodes.stages.rows import SAMPLE_ERRORS
from measurements.accuracy.diagram import (
    FAILED,
    Diagram,
    DiagramRow,
    Size,
    TimedError,
    in_fresh_process,
    size_suffix,
    summarise,
    timed,
)
from measurements.accuracy.packings import compressed

PHI, INTERACTION = 0.9, Interaction.from_law(ContactLaw(kt=1.0))
"""k_T = k_N: with a smaller one the damped dynamics needs more steps, rotations being slower."""

STRAINS = tuple(10.0**-k for k in range(2, 10))


class Method(NamedTuple):
    """How g is found, and how a step is relaxed."""

    find: Callable[[Packing, StepStrain], float]
    protocol: StepStrain


def forward(packing: Packing, protocol: StepStrain) -> float:
    """g of one step forward, as A takes it."""
    return forward_rigidity(packing, INTERACTION, protocol)


def both_sides(packing: Packing, protocol: StepStrain) -> float:
    """g of one step to either side."""
    steps = relaxed_steps(backbone(packing, 2), INTERACTION, protocol)
    if not all(step.converged for step in steps):
        raise ArithmeticError(f"max|F| = {max(step.max_force for step in steps):.1e}")
    after, before = (stress(s.packing, INTERACTION)[0, 1] for s in steps)
    return float(after - before) / (2.0 * protocol.strain)


def shrinking(packing: Packing, protocol: StepStrain) -> float:
    """g by the default rule, whose first step is Δγ."""
    found = step_strain(packing, INTERACTION, protocol)
    if not found.converged:
        raise ArithmeticError(f"max|F| = {found.max_force:.1e}")
    return found.g


DAMPED = StepStrain(relaxation="damped", max_steps=2_000_000)
METHODS = {
    "damped to 1e-14, forward": Method(forward, DAMPED),
    "damped to 1e-10, forward": Method(forward, replace(DAMPED, force_tolerance=1e-10)),
    "Newton, forward": Method(forward, StepStrain()),
    "Newton, both sides": Method(both_sides, StepStrain()),
    "Newton, both sides, until two sizes agree": Method(shrinking, StepStrain()),
}
DEFAULT = "Newton, both sides, until two sizes agree", StepStrain().strain


def measure(size: Size) -> Iterator[DiagramRow]:
    """A row for every method and Δγ."""
    for n in size.n:
        packings = [compressed(n, seed, PHI) for seed in range(size.seeds)]
        for name in METHODS:
            for strain in STRAINS:
                done = in_fresh_process(timed_errors, name, strain, packings)
                default = (name, strain) == DEFAULT
                yield summarise(f"{name}{size_suffix(n, size)}", strain, *done[::2], default)


def timed_errors(name: str, strain: float, packings: list[Packing]) -> list[TimedError]:
    """The error of g of every packing."""
    method = METHODS[name]
    protocol = replace(method.protocol, strain=strain)
    method.find(packings[0], protocol)
    return [_timed_error(method.find, packing, protocol) for packing in packings]


def _timed_error(find: Callable, packing: Packing, protocol: StepStrain) -> TimedError:
    exact = rigidity(packing, INTERACTION).unloaded.g
    try:
        g, seconds = timed(find, packing, protocol)
    except SAMPLE_ERRORS:
        return FAILED
    return TimedError(seconds, abs(g / exact - 1.0))


DIAGRAM = Diagram(
    title="Size of a step strain, φ = 0.90, k_T/k_N = 1",
    setting="Δγ",
    unit="modulus",
    error=r"$|g_{\rm sim} - g| \,/\, |g|$",
    reference="g by one solve with J in the same state",
    small=Size((64,), 8),
    large=Size((256, 1024), 16),
    measure=measure,
)
