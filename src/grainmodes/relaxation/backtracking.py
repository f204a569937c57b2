"""The line search of Newton's method: a step is halved until it improves the state."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

MIN_STEP_FRACTION = 0.1
"""Smallest fraction of a Newton step that is tried: below it no balance is near."""

State = TypeVar("State")


def backtrack(
    state_at: Callable[[float], State], improves: Callable[[State], bool]
) -> State | None:
    """The first state that improves among those after 1, ½, ¼, … of a step; None if none does.

    Args:
        state_at: the state after a fraction of the step.
        improves: whether a state is better than the one before the step.
    """
    fraction = 1.0
    while fraction >= MIN_STEP_FRACTION:
        state = state_at(fraction)
        if improves(state):
            return state
        fraction *= 0.5
    return None
