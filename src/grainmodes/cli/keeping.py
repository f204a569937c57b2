"""Long walks kept beside their output, and a line that says how far they are.

A walk is pickled to `.<output>.<name>.kept`, written whole or not at all. It is taken up again only
by the same code, from the same packings with the same choices; anything else on that path is passed
over. An interrupted sample so goes on where it stood some minutes before, and ends with the same
bytes.
"""

from __future__ import annotations

import hashlib
import pickle
import sys
import time
from pathlib import Path

import numpy as np

from grainmodes.atomic import replaced
from grainmodes.dataset.files import Block
from grainmodes.protocols.shear import Walk
from grainmodes.provenance import code_version

LINE_EVERY = 2.0
"""Seconds between two lines on a terminal; elsewhere one stands for every walk kept."""


def fingerprint(packings: Block) -> str:
    """Tells the packings of a block from any others."""
    digest = hashlib.sha256()
    for name, array in sorted(packings.variables.items()):
        digest.update(name.encode() + np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


class Keeping:
    """Keeps the walks of one output file.

    Args:
        output: the file that will hold the finished block.
        start: all that a walk depends on besides the code: law, choices, packings.
        seconds: how often a walk is kept.
    """

    def __init__(self, output: Path, start: tuple, seconds: float):
        self._output, self._seconds = output, seconds
        self._mark = (code_version(), start)
        self._kept: set[Path] = set()

    def kept(self, name: str) -> Walk | None:
        """The walk of this name as far as it came, if this code kept one."""
        walk = self._read(self._path(name))
        self._started = self._kept_at = self._said_at = time.monotonic()
        self._from = (walk.now.strain, len(walk.curve)) if walk else (0.0, 0)
        return walk

    def _read(self, path: Path) -> Walk | None:
        if not path.is_file():
            return None
        self._kept.add(path)
        try:
            mark, walk = pickle.loads(path.read_bytes())
        except Exception:
            return None  # a foreign or a broken file: the sample begins anew
        return walk if mark == self._mark else None

    def watch(self, name: str, walk: Walk) -> None:
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

    def _say(self, name: str, walk: Walk, now: float) -> None:
        self._said_at = now
        strain, last, elapsed = walk.now.strain, walk.choices.strain, now - self._started
        first, states = self._from
        left = (last - strain) / (strain - first) * elapsed if strain > first else float("inf")
        pace = (len(walk.curve) - states) / elapsed
        print(
            f"{name}: strain {strain:.4f} of {last:g}, {len(walk.events)} events, "
            f"{pace:.0f} states per second, {left / 60.0:.0f} min left",
            file=sys.stderr,
            flush=True,
        )
