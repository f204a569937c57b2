"""A claim: who writes a file, or runs the workflow in a folder, so that nobody else does.

A claim is a small file that only one process can create. It names its owner, which touches it every
`BEAT` seconds. It is stale only if its owner is provably gone: on the same system no process has
its number and start; from elsewhere it was not touched for `PATIENCE` seconds. Only whether it was
touched counts, not when, so that no two clocks are compared.
"""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from grainmodes.runtime.failures import MachineError
from grainmodes.runtime.processes import Process

BEAT = 15.0
"""Seconds after which an owner touches its claims again."""

PATIENCE = 120.0
"""Seconds without a touch after which an owner that cannot be seen from here is gone. A shared file
system may show a touch a minute late."""

LOOK_EVERY = 0.2
"""Seconds between two looks at a claim that is in the way."""


class ClaimedError(MachineError):
    """Another process holds the claim, and lives."""


class Claim:
    """A claim that this process holds."""

    def __init__(self, path: Path):
        self._path = path

    def touch(self) -> None:
        """Show that the owner lives."""
        with suppress(OSError):  # without the folder, what is written there fails by itself
            os.utime(self._path)

    def touch_in_background(self) -> None:
        """Show it every `BEAT` seconds until this process ends."""
        threading.Thread(target=self._touch_for_ever, daemon=True).start()

    def _touch_for_ever(self) -> None:
        while True:
            time.sleep(BEAT)
            self.touch()

    def release(self) -> None:
        """Remove the claim, if it is still that of this process."""
        if owner_of(self._path) == Process.current():
            self._path.unlink(missing_ok=True)


def take(path: Path, what: str, wait: bool, tell: Callable[[str], None]) -> Claim:
    """The claim under `path`, once it is free.

    Args:
        what: what its owner does, as the start of a sentence.
        wait: whether to wait for the end of an owner that lives.
        tell: gets a sentence, once, if there is something to wait for.

    Raises:
        ClaimedError: its owner lives, and `wait` is False.
        OSError: the claim cannot be written.
    """
    touched, since = None, time.monotonic()
    beats, told = 0, False
    while not _create(path):
        owner, now = owner_of(path), _touched(path)
        if owner == Process.current():
            break
        if now != touched:
            touched, since, beats = now, time.monotonic(), beats + 1
        lives = (owner is not None and owner.is_here) or beats > 1
        if (owner and owner.is_gone) or time.monotonic() - since > PATIENCE:
            _remove(path, owner)
            continue
        if lives and not wait:
            raise ClaimedError(f"{what}: expected no other run, got {owner}")
        if not told:
            tell(f"{what}: waiting for {owner or 'another process'}")
            told = True
        time.sleep(LOOK_EVERY)
    return Claim(path)


def owner_of(path: Path) -> Process | None:
    """The owner that a claim names; None without a readable claim."""
    try:
        return Process(**json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None


def _create(path: Path) -> bool:
    path.parent.mkdir(parents=True, exist_ok=True)
    try:
        with path.open("x", encoding="utf-8") as file:
            json.dump(Process.current()._asdict(), file)
    except FileExistsError:
        return False
    return True


def _remove(path: Path, owner: Process | None) -> None:
    """Remove a stale claim, unless somebody else was faster and has made a new one."""
    aside = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        path.rename(aside)
    except FileNotFoundError:
        return
    if owner_of(aside) != owner:
        with suppress(OSError):  # there may be a third one by now
            os.link(aside, path)
    aside.unlink(missing_ok=True)


def _touched(path: Path) -> int | None:
    """When the claim was touched, in the time of its file system; None without a claim."""
    try:
        with path.open("rb") as file:  # a shared file system then asks its server
            return os.fstat(file.fileno()).st_mtime_ns
    except OSError:
        return None
