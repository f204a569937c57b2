"""Checkpoints of long runs in files beside their output, and a line that says how far a run is.

A run is pickled to `.<output>.<name>.checkpoint`, written whole or not at all, behind the checksum
of its content. It is read back only by the same code, for the same packings with the same choices;
any other content of that file is ignored. So an interrupted sample goes on where it was some
minutes before, and ends with the same bytes.
"""

from __future__ import annotations

import hashlib
import pickle
import sys
import time
from pathlib import Path
from typing import Generic

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.runtime.atomic import replaced
from grainmodes.runtime.progress import Progress
from grainmodes.runtime.provenance import code_version
from grainmodes.stages.long_runs import Run

CHECKSUM = hashlib.sha256().digest_size
"""Bytes at the start of a checkpoint: the SHA-256 of the rest."""

SECONDS_PER_LINE = 2.0
"""Seconds between two lines on a terminal; elsewhere there is one line for every checkpoint."""


def fingerprint(block: Block) -> str:
    """A hash that differs between blocks of different content."""
    digest = hashlib.sha256()
    for name, array in sorted(block.variables.items()):
        digest.update(name.encode() + np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


class CheckpointFiles(Generic[Run]):
    """The checkpoints of the runs of one output file.

    Args:
        output: the file that will hold the finished block.
        start: everything that a run depends on besides the code: law, choices, packings.
        seconds: least time between two checkpoints of a run.
    """

    def __init__(self, output: Path, start: tuple[object, ...], seconds: float):
        self._output, self._seconds = output, seconds
        self._mark = (code_version(), start)
        self._files: set[Path] = set()

    def load(self, name: str) -> Run | None:
        """The saved run of this name, if this code saved one from the same start."""
        run = self._read(self._path(name))
        self._started = self._saved_at = self._printed_at = time.monotonic()
        self._first = run.progress if run else Progress(0.0, "", 0, "")
        return run

    def _read(self, path: Path) -> Run | None:
        if not path.is_file():
            return None
        self._files.add(path)
        content = path.read_bytes()
        checksum, content = content[:CHECKSUM], content[CHECKSUM:]
        if hashlib.sha256(content).digest() != checksum:
            return None  # a foreign or damaged file: the sample starts from its beginning
        try:
            mark, run = pickle.loads(content)
        except Exception:
            return None  # of another version of the code
        return run if mark == self._mark else None

    def save_if_due(self, name: str, run: Run) -> None:
        """Save the run if enough time has passed and the run is restartable; print its progress."""
        now = time.monotonic()
        if now - self._saved_at > self._seconds and run.restartable:
            path = self._path(name)
            with replaced(path) as partial:
                content = pickle.dumps((self._mark, run))
                partial.write_bytes(hashlib.sha256(content).digest() + content)
            self._files.add(path)
            self._saved_at = now
            self._print_progress(name, run, now)
        elif sys.stderr.isatty() and now - self._printed_at > SECONDS_PER_LINE:
            self._print_progress(name, run, now)

    def discard(self) -> None:
        """Remove all checkpoints, once the output is complete."""
        for path in self._files:
            path.unlink(missing_ok=True)

    def _path(self, name: str) -> Path:
        return self._output.with_name(f".{self._output.name}.{name}.checkpoint")

    def _print_progress(self, name: str, run: Run, now: float) -> None:
        self._printed_at = now
        first, here, elapsed = self._first, run.progress, now - self._started
        gain = here.done - first.done
        left = (1.0 - here.done) / gain * elapsed if gain > 0.0 else float("inf")
        speed = (here.count - first.count) / elapsed
        print(
            f"{name}: {here.words}, {speed:.0f} {here.unit} per second, {left / 60.0:.0f} min left",
            file=sys.stderr,
            flush=True,
        )
