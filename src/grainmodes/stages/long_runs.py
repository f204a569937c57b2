"""Samples that run for minutes to hours: how they go on, and from where after an interruption.

A shear and the release of an unstable state are long runs. A stage hands them a store of
checkpoints, or none. An interruption leaves no trace in the numbers: a checkpoint is saved only
where the state of the run alone determines what follows (`LongRun.restartable`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeVar

from grainmodes.runtime.progress import Progress


class LongRun(Protocol):
    """A simulation that goes on step by step and can be pickled between two steps."""

    @property
    def done(self) -> bool:
        """Whether the run has reached its end."""

    @property
    def restartable(self) -> bool:
        """Whether the run, read back from a checkpoint here, ends with the same bytes."""

    @property
    def progress(self) -> Progress:
        """How far the run is."""

    def advance(self) -> bool:
        """Take one step; False if no step is possible."""


Run = TypeVar("Run", bound=LongRun)


class CheckpointStore(Protocol[Run]):
    """A place where the runs of one block are saved between two jobs."""

    def load(self, name: str) -> Run | None:
        """The saved run of this name, if there is one."""

    def save_if_due(self, name: str, run: Run) -> None:
        """Save the run if enough time has passed and the run is `restartable`."""


def run_to_end(
    start: Callable[[], Run], checkpoints: CheckpointStore[Run] | None, name: str
) -> Run:
    """Start a run, or continue it from its checkpoint, and advance it as far as it goes.

    Args:
        start: makes the run from its beginning, where there is no checkpoint.
        name: name of the run among the checkpoints.
    """
    saved = checkpoints.load(name) if checkpoints else None
    run = start() if saved is None else saved
    while not run.done and run.advance():
        if checkpoints:
            checkpoints.save_if_due(name, run)
    return run
