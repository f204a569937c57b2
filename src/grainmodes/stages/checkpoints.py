"""Long walks kept beside their output, and a line that says how far they are.

A walk is a shear, or the run of a release. It is pickled to `.<output>.<name>.kept`, written whole
or not at all. It is taken up again only by the same code, from the same packings with the same
choices; anything else on that path is passed over. An interrupted sample so goes on where it stood
some minutes before, and ends with the same bytes.
"""

from __future__ import annotations

import hashlib
import pickle
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.protocols.release.run import Run
from grainmodes.protocols.shear.run import Walk
from grainmodes.runtime.atomic import replaced
from grainmodes.runtime.provenance import code_version

LINE_EVERY = 2.0
"""Seconds between two lines on a terminal; elsewhere one stands for every walk kept."""


def fingerprint(packings: Block) -> str:
    """Tells the packings of a block from any others."""
    digest = hashlib.sha256()
    for name, array in sorted(packings.variables.items()):
        digest.update(name.encode() + np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


class Progress(NamedTuple):
    """How far a walk is: the part done, where that is in words, and a count of some unit."""

    done: float
    words: str
    count: int
    unit: str


def of_walk(walk: Walk) -> Progress:
    """How far a shear is."""
    strain, last = walk.now.strain, walk.choices.strain
    words = f"strain {strain:.4f} of {last:g}, {len(walk.events)} events"
    return Progress(strain / last, words, len(walk.curve), "states")


def of_run(run: Run) -> Progress:
    """How far the run of a release is."""
    square = run.records[-1].mean_square_displacement
    words = f"{run.steps} of {run.last} steps, M = {square:.1e}"
    return Progress(run.steps / run.last, words, run.steps, "steps")


class Keeping:
    """Keeps the walks of one output file.

    Args:
        output: the file that will hold the finished block.
        start: all that a walk depends on besides the code: law, choices, packings.
        seconds: how often a walk is kept.
        progress: tells how far a walk is.
    """

    def __init__(
        self,
        output: Path,
        start: tuple,
        seconds: float,
        progress: Callable[[Walk | Run], Progress] = of_walk,
    ):
        self._output, self._seconds, self._progress = output, seconds, progress
        self._mark = (code_version(), start)
        self._kept: set[Path] = set()

    def kept(self, name: str) -> Walk | Run | None:
        """The walk of this name as far as it came, if this code kept one."""
        walk = self._read(self._path(name))
        self._started = self._kept_at = self._said_at = time.monotonic()
        self._from = self._progress(walk) if walk else Progress(0.0, "", 0, "")
        return walk

    def _read(self, path: Path) -> Walk | Run | None:
        if not path.is_file():
            return None
        self._kept.add(path)
        try:
            mark, walk = pickle.loads(path.read_bytes())
        except Exception:
            return None  # a foreign or a broken file: the sample begins anew
        return walk if mark == self._mark else None

    def watch(self, name: str, walk: Walk | Run) -> None:
        """Keep the walk if it is time to; say how far it is."""
        now = time.monotonic()
        if now - self._kept_at > self._seconds and walk.restartable:
            path = self._path(name)
            with replaced(path) as partial:
                partial.write_bytes(pickle.dumps((self._mark, walk)))
            self._kept.add(path)
            self._kept_at = now
            self._say(name, walk, now)
        elif sys.stderr.isatty() and now - self._said_at > LINE_EVERY:
            self._say(name, walk, now)

    def forget(self) -> None:
        """Remove what was kept: the output is complete."""
        for path in self._kept:
            path.unlink(missing_ok=True)

    def _path(self, name: str) -> Path:
        return self._output.with_name(f".{self._output.name}.{name}.kept")

    def _say(self, name: str, walk: Walk | Run, now: float) -> None:
        self._said_at = now
        first, here, elapsed = self._from, self._progress(walk), now - self._started
        way = here.done - first.done
        left = (1.0 - here.done) / way * elapsed if way > 0.0 else float("inf")
        pace = (here.count - first.count) / elapsed
        print(
            f"{name}: {here.words}, {pace:.0f} {here.unit} per second, {left / 60.0:.0f} min left",
            file=sys.stderr,
            flush=True,
        )
