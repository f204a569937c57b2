"""The first event of a shear in ever narrower brackets: B, Appendix B, Figs. 11 and 12.

Every bracket is found by a run of its own from γ = 0, with Δγ_Th = Δγ_in 10^-k. Without friction an
equilibrium does not depend on the path, and each bracket lies within the wider ones. With friction
an affine step may open a contact that a shorter step would have kept. The spring of this contact is
lost, and the event comes early, by less than the step. So a bracket may end below a narrower one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.events import PlasticEvent
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun, units_per_step
from grainmodes.protocols.shear.sheared_state import CurvePoint, ShearedState

BRACKET_COUNT = 7
"""Number of brackets: Δγ_Th from Δγ_in down to 1e-6 of it, in B from 1e-4 to 1e-10."""

CURVE_MARGIN = 2
"""Steps Δγ_in of the curve that are kept on both sides of an event."""


@dataclass(frozen=True)
class Bracket:
    """The first event between the states `before` and `after`, and the curve around it.

    Without an event `before` is the last state of the run, `event` and `after` are None. `failure`
    is why the run ended before its last strain, if it found no event up to there.
    """

    min_step: float
    before: ShearedState
    curve: list[CurvePoint]
    event: PlasticEvent | None = None
    after: ShearedState | None = None
    failure: Exception | None = None


def refined_steps(choices: Shear) -> list[Shear]:
    """The same shear with every Δγ_Th, the largest first."""
    return [replace(choices, min_step=choices.step / 10**k) for k in range(BRACKET_COUNT)]


def accepted_steps(run: QuasistaticRun) -> Iterator[tuple[ShearedState, ShearedState]]:
    """Let a run go on, and yield the states before and after every step that it accepts."""
    while not run.done:
        before = run.state
        if not run.advance():
            return
        if run.state is not before:
            yield before, run.state


def bracket_first_event(
    packing: Packing, interaction: Interaction, choices: Shear
) -> list[Bracket]:
    """The first event of a shear at every Δγ_Th, the largest first.

    Up to the step that contains the event all runs are the same, and are computed once.

    Raises:
        ArithmeticError: the packing has no stable equilibrium.
    """
    widest, *narrower = refined_steps(choices)
    found = [run_to_first_event(QuasistaticRun.from_packing(packing, interaction, widest))]
    start = found[0].before
    curve = [point for point in found[0].curve if point.strain <= start.strain]
    for decade, refined in enumerate(narrower, start=1):
        state = replace(start, strain_units=start.strain_units * 10**decade)
        run = QuasistaticRun(state, refined, units_per_step(refined), curve=curve.copy())
        found.append(run_to_first_event(run))
    return found


def run_to_first_event(run: QuasistaticRun) -> Bracket:
    """The first event of a run, which then goes on for `CURVE_MARGIN` steps."""
    min_step, width = run.choices.min_step, CURVE_MARGIN * run.choices.step
    for before, after in accepted_steps(run):
        if not run.events:
            continue
        event = run.events[0]
        for _, state in accepted_steps(run):
            if state.strain >= after.strain + width:
                break
        curve = [point for point in run.curve if abs(point.strain - after.strain) < 1.001 * width]
        return Bracket(min_step, before, curve, event, after)
    failure = None if run.done else run.failure
    return Bracket(min_step, run.state, run.curve[-1:], failure=failure)
