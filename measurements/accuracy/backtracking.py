"""Δγ_Th of quasistatic shear: how closely an event is bracketed. B, Appendix B, Fig. 12.

The strain grows in steps of Δγ_in = 1e-4. A step with an event is taken back and tried again with a
tenth of its length, down to Δγ_Th; γ_c is the middle of the final bracket. So γ_c is known to
Δγ_Th / 2, and each decade takes at most ten more steps, however far the event is. Without
backtracking every step up to the event would be as short. B finds that γ_c converges for
Δγ_Th ≤ 1e-6 (B5).

Which event is the first also depends on Δγ_in: σ rises by g Δγ_in in a step, and a stress drop is
noticed only if it is larger. Without friction the first event is the opening of a contact, g falls,
and every Δγ_in notices it; with friction shorter steps notice smaller drops, and notice them
earlier.

Reference: γ_c of a separate shear with Δγ_in = 1e-4 and Δγ_Th = 1e-12. Samples without an event up
to `LARGEST_STRAIN` have failed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import accepted_steps
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.relaxation.frictionless import relax_fire_newton
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

PHI, LARGEST_STRAIN = 0.9, 0.1

DEFAULT, REFERENCE_WIDTH = Shear(), 1e-12
"""The defaults, and Δγ_Th of the reference."""

FRICTION = Interaction.from_law(ContactLaw("harmonic", "elastic", 1.0))
FRICTIONLESS = Interaction.from_law(ContactLaw("harmonic"))
"""B's law, k_T = k_N, and without friction."""


WIDTHS = tuple(10.0**-k for k in range(4, 11))
COARSE_WIDTHS = (1e-3, 1e-4, 1e-5)
"""Δγ_Th to try with brackets, and without, where every step is as short as Δγ_Th."""


class Bracketing(NamedTuple):
    """A law, and whether steps are taken back; else all are as short as Δγ_Th."""

    interaction: Interaction
    backtracking: bool

    @property
    def widths(self) -> tuple[float, ...]:
        """The Δγ_Th to try."""
        return WIDTHS if self.backtracking else COARSE_WIDTHS

    def shear(self, width: float) -> Shear:
        """The shear with brackets of this width."""
        return Shear(LARGEST_STRAIN, DEFAULT.step if self.backtracking else width, width)


BRACKETINGS = {
    "friction, steps taken back": Bracketing(FRICTION, True),
    "no friction, steps taken back": Bracketing(FRICTIONLESS, True),
    "friction, every step as short": Bracketing(FRICTION, False),
    "no friction, every step as short": Bracketing(FRICTIONLESS, False),
}


def measure(size: Size) -> Iterator[DiagramRow]:
    """A row for every kind of bracketing and Δγ_Th."""
    for n in size.n:
        packings = [harmonic(n, seed) for seed in range(size.seeds)]
        for name, bracketing in BRACKETINGS.items():
            closest = Shear(LARGEST_STRAIN, DEFAULT.step, REFERENCE_WIDTH)
            exact = [
                critical_strain(packing, bracketing.interaction, closest) for packing in packings
            ]
            for width in bracketing.widths:
                done = in_fresh_process(timed_errors, name, width, packings, exact)
                default = bracketing.backtracking and width == DEFAULT.min_step
                yield summarise(
                    f"{name}{size_suffix(n, size)}", width, done.value, done.megabytes, default
                )


def harmonic(n: int, seed: int) -> Packing:
    """A packing of harmonic grains in its final balance."""
    packing = compressed(n, seed, PHI)
    return relax_fire_newton(packing, FRICTION.normal, DEFAULT.force_tolerance, 10_000_000).packing


def timed_errors(
    name: str, width: float, packings: list[Packing], exact: list[float]
) -> list[TimedError]:
    """The error of γ_c of every packing."""
    bracketing = BRACKETINGS[name]
    critical_strain(packings[0], bracketing.interaction, Shear(2e-4, 1e-4, 1e-6))
    return [_timed_error(bracketing, width, *pair) for pair in zip(packings, exact, strict=True)]


def _timed_error(
    bracketing: Bracketing, width: float, packing: Packing, exact: float
) -> TimedError:
    strain, seconds = timed(
        critical_strain, packing, bracketing.interaction, bracketing.shear(width)
    )
    return FAILED if math.isnan(strain - exact) else TimedError(seconds, abs(strain - exact))


def critical_strain(packing: Packing, interaction: Interaction, shear: Shear) -> float:
    """γ_c, the middle of the bracket of the first event; NaN where there is none."""
    try:
        run = QuasistaticRun.from_packing(packing, interaction, shear)
    except SAMPLE_ERRORS:
        return math.nan
    for before, after in accepted_steps(run):
        if run.events:
            return (before.strain + after.strain) / 2.0
    return math.nan


DIAGRAM = Diagram(
    title="Bracket of an event, φ = 0.90, harmonic, k_T/k_N = 1 or no friction",
    setting=r"$\Delta\gamma_{\rm Th}$",
    unit="event",
    error=r"error of $\gamma_c$",
    reference="the same event in a bracket of 1e-12",
    small=Size((64,), 8),
    large=Size((256, 1024), 32),
    measure=measure,
)
