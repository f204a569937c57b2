"""The first event of a shear, bracketed ever closer: B, Appendix B, Figs. 11 and 12.

Every bracket is a walk of its own from γ = 0 with its own Δγ_Th = Δγ_in 10^-k. Without friction a
balance does not depend on the path, and each bracket lies within the coarser ones. With friction an
affine step may open a contact that a shorter one would have kept; its spring is lost, and the event
comes early, by less than the step. So a bracket may end below a finer one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from grainmodes.packing import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear import Walk
from grainmodes.protocols.sheared_state import Event, Point, State

DECADES = 7
"""Brackets of an event: Δγ_Th from Δγ_in down to 1e-6 of it, in B from 1e-4 to 1e-10."""

AROUND = 2
"""Steps Δγ_in of the curve that are kept on both sides of an event."""


@dataclass(frozen=True)
class Bracket:
    """The first event between two states, and the curve around it; no event: the end of a walk."""

    smallest_step: float
    curve: list[Point]
    event: Event | None = None
    before: State | None = None
    after: State | None = None


def closer(choices: Shear) -> list[Shear]:
    """The same shear with every Δγ_Th, the largest first."""
    return [replace(choices, smallest_step=choices.step / 10**k) for k in range(DECADES)]


def steps(walk: Walk) -> Iterator[tuple[State, State]]:
    """Every step that a walk takes, as the states before and after it, up to its end."""
    while not walk.done:
        before = walk.now
        if not walk.advance():
            return
        if walk.now is not before:
            yield before, walk.now


def bracketed(packing: Packing, interaction, choices: Shear) -> Bracket:
    """A shear up to its first event and `AROUND` steps beyond.

    Raises:
        ArithmeticError: the packing has no stable balance.
    """
    walk = Walk.start(packing, interaction, choices)
    for before, after in steps(walk):
        if walk.events:
            event, width = walk.events[0], AROUND * choices.step
            _go_on(walk, after.strain + width)
            curve = [p for p in walk.curve if abs(p.strain - after.strain) < 1.001 * width]
            return Bracket(choices.smallest_step, curve, event, before, after)
    return Bracket(choices.smallest_step, walk.curve[-1:])


def _go_on(walk: Walk, strain: float) -> None:
    for _, now in steps(walk):
        if now.strain >= strain:
            return
