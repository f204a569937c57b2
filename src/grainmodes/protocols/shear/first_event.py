"""The first event of a shear, bracketed ever closer: B, Appendix B, Figs. 11 and 12.

Every bracket is that of a walk of its own from γ = 0, Δγ_Th = Δγ_in 10^-k. Without friction a
balance does not depend on the path, and each bracket lies within the coarser ones. With friction an
affine step may open a contact that a shorter one would have kept; its spring is lost, and the event
comes early, by less than the step. So a bracket may end below a finer one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.run import Walk, steps_per_grid
from grainmodes.protocols.shear.state import Event, Point, State

DECADES = 7
"""Brackets of an event: Δγ_Th from Δγ_in down to 1e-6 of it, in B from 1e-4 to 1e-10."""

AROUND = 2
"""Steps Δγ_in of the curve that are kept on both sides of an event."""


@dataclass(frozen=True)
class Bracket:
    """The first event between two states, and the curve around it.

    Without an event `before` is where the walk ended.
    """

    min_step: float
    before: State
    curve: list[Point]
    event: Event | None = None
    after: State | None = None


def closer(choices: Shear) -> list[Shear]:
    """The same shear with every Δγ_Th, the largest first."""
    return [replace(choices, min_step=choices.step / 10**k) for k in range(DECADES)]


def steps(walk: Walk) -> Iterator[tuple[State, State]]:
    """Every step that a walk takes, as the states before and after it, up to its end."""
    while not walk.done:
        before = walk.now
        if not walk.advance():
            return
        if walk.now is not before:
            yield before, walk.now


def brackets(packing: Packing, interaction, choices: Shear) -> list[Bracket]:
    """The first event at every Δγ_Th, the largest first.

    Up to the step with the event all walks are the same, and are walked once.

    Raises:
        ArithmeticError: the packing has no stable balance.
    """
    first, *rest = closer(choices)
    found = [bracketed(Walk.start(packing, interaction, first))]
    start = found[0].before
    curve = [point for point in found[0].curve if point.strain <= start.strain]
    for decade, of in enumerate(rest, start=1):
        now = replace(start, units=start.units * 10**decade)
        found.append(bracketed(Walk(now, of, steps_per_grid(of), curve=curve.copy())))
    return found


def bracket_ends(found: list[Bracket]) -> dict[str, list[float]]:
    """Both sides of the first event in every bracket; NaN where there is no event."""
    return {
        "bracket_min_step": [b.min_step for b in found],
        "bracket_strain_before": [b.before.strain if b.event else np.nan for b in found],
        "bracket_strain_after": [b.after.strain if b.event else np.nan for b in found],
    }


def bracketed(walk: Walk) -> Bracket:
    """The first event of a walk, which then goes on for `AROUND` steps."""
    for before, after in steps(walk):
        if walk.events:
            event, width = walk.events[0], AROUND * walk.choices.step
            _go_on(walk, after.strain + width)
            curve = [p for p in walk.curve if abs(p.strain - after.strain) < 1.001 * width]
            return Bracket(walk.choices.min_step, before, curve, event, after)
    return Bracket(walk.choices.min_step, walk.now, walk.curve[-1:])


def _go_on(walk: Walk, strain: float) -> None:
    for _, now in steps(walk):
        if now.strain >= strain:
            return
