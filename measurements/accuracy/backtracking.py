"""Δγ_Th of quasistatic shear: how closely an event is bracketed. B, Appendix B, Fig. 12.

The strain grows in steps of Δγ_in = 1e-4. A step with an event is taken back and tried again with a
tenth of its length, down to Δγ_Th; γ_c is the middle of the bracket that is left. So γ_c is known
to Δγ_Th / 2, and each decade takes at most ten steps more, whatever the way to the event. Without
backtracking every step on the way would be as short. B finds that γ_c converges for
Δγ_Th ≤ 1e-6 (B5).

Which event is the first hangs on Δγ_in too: σ rises by g Δγ_in in a step, and a stress drop is seen
only where it is larger. Without friction the first event is a contact that opens, g falls, and
every Δγ_in sees it; with friction shorter steps see smaller drops, and see them earlier.

Reference: γ_c of a walk of its own with Δγ_in = 1e-4 and Δγ_Th = 1e-12. Samples without an event up
to `LAST` have failed.
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
from measurements.accuracy.diagram import FAILED, Diagram, Row, Sample, Size, apart, of, row, timed
from measurements.accuracy.packings import compressed

PHI, LAST = 0.9, 0.1

SHIPPED, CLOSEST = Shear(), 1e-12
"""The defaults, and Δγ_Th of the reference."""

FRICTION = Interaction.from_law(ContactLaw("harmonic", "elastic", 1.0))
FRICTIONLESS = Interaction.from_law(ContactLaw("harmonic"))
"""B's law, k_T = k_N, and without friction."""


WIDTHS = tuple(10.0**-k for k in range(4, 11))
COARSE = (1e-3, 1e-4, 1e-5)
"""Δγ_Th, and the steps that a whole way can be walked in."""


class Way(NamedTuple):
    """A law, and whether steps are taken back; else all are as short as Δγ_Th."""

    interaction: Interaction
    backtracking: bool

    @property
    def widths(self) -> tuple[float, ...]:
        """The Δγ_Th to try."""
        return WIDTHS if self.backtracking else COARSE

    def shear(self, width: float) -> Shear:
        """The shear whose bracket is so wide."""
        return Shear(LAST, SHIPPED.step if self.backtracking else width, width)


WAYS = {
    "friction, steps taken back": Way(FRICTION, True),
    "no friction, steps taken back": Way(FRICTIONLESS, True),
    "friction, every step as short": Way(FRICTION, False),
    "no friction, every step as short": Way(FRICTIONLESS, False),
}


def measure(size: Size) -> Iterator[Row]:
    """A row for every way and Δγ_Th."""
    for n in size.n:
        packings = [harmonic(n, seed) for seed in range(size.seeds)]
        for name, way in WAYS.items():
            closest = Shear(LAST, SHIPPED.step, CLOSEST)
            exact = [critical_strain(packing, way.interaction, closest) for packing in packings]
            for width in way.widths:
                done = apart(sampled, name, width, packings, exact)
                default = way.backtracking and width == SHIPPED.min_step
                yield row(f"{name}{of(n, size)}", width, done.value, done.megabytes, default)


def harmonic(n: int, seed: int) -> Packing:
    """A packing of harmonic grains in its final balance."""
    packing = compressed(n, seed, PHI)
    return relax_fire_newton(packing, FRICTION.normal, SHIPPED.force_tolerance, 10_000_000).packing


def sampled(name: str, width: float, packings: list[Packing], exact: list[float]) -> list[Sample]:
    """The error of γ_c of every packing."""
    way = WAYS[name]
    critical_strain(packings[0], way.interaction, Shear(2e-4, 1e-4, 1e-6))
    return [_sample(way, width, *of) for of in zip(packings, exact, strict=True)]


def _sample(way: Way, width: float, packing: Packing, exact: float) -> Sample:
    strain, seconds = timed(critical_strain, packing, way.interaction, way.shear(width))
    return FAILED if math.isnan(strain - exact) else Sample(seconds, abs(strain - exact))


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
