"""Processes that end with the one that started them, and how a process is known for sure.

| part   | taken from                           | why                                           |
| ------ | ------------------------------------ | --------------------------------------------- |
| host   | name of the machine                  | for messages                                  |
| place  | start of the system and namespace    | process ids can be compared within one only   |
| number | process id                           |                                               |
| start  | clock ticks since the system started | an id is used again                           |
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import signal
import socket
import sys
import threading
import time
from functools import cache
from pathlib import Path
from typing import NamedTuple

PR_SET_PDEATHSIG = 1
"""`prctl`: the signal that a process gets when the thread that started it ends (Linux)."""

LOOK_EVERY = 0.5
"""Seconds between two looks at a process on whose life another one depends."""


class Process(NamedTuple):
    """A process, known for sure on its own machine: `place` holds machine, boot and namespace."""

    host: str
    place: str
    number: int
    start: str

    @classmethod
    def current(cls) -> Process:
        """This process."""
        return cls.with_number(os.getpid())

    @classmethod
    def with_number(cls, number: int) -> Process:
        """A process of this machine by its process id."""
        return cls(socket.gethostname(), place(), number, start_of(number))

    @property
    def mark(self) -> str:
        """A word for the name of a file that this process writes."""
        system = hashlib.sha256(self.place.encode()).hexdigest()[:8]
        return f"{system}-{self.number}-{self.start}"

    @property
    def is_here(self) -> bool:
        """Whether this process can be seen from here, so that its end can be proven."""
        return self.place == place()

    @property
    def is_gone(self) -> bool:
        """Whether it has provably ended; False where it cannot be seen from here."""
        return self.is_here and (not self.start or start_of(self.number) != self.start)

    def __str__(self) -> str:
        return f"process {self.number} on {self.host}"


@cache
def place() -> str:
    """A name of the running system and the namespace of process ids in it."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
        return f"{boot} {os.readlink('/proc/self/ns/pid')}"
    except OSError:
        import psutil

        return f"{socket.gethostname()} {psutil.boot_time():.0f}"


def start_of(number: int) -> str:
    """When a process of this system started; "" if there is none, or if it has ended."""
    try:
        words = Path(f"/proc/{number}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return "" if sys.platform == "linux" else _start_by_psutil(number)
    state, *after = words.rpartition(")")[2].split()
    return "" if state in "ZX" else after[18]


def _start_by_psutil(number: int) -> str:
    import psutil

    try:
        process = psutil.Process(number)
        dead = process.status() == psutil.STATUS_ZOMBIE
        return "" if dead else f"{process.create_time():.2f}"
    except psutil.Error:
        return ""


def is_single_threaded() -> bool:
    """Whether this process has a single thread, those of libraries counted, so that a copy of it
    is whole; False where it cannot be seen."""
    try:
        return len(os.listdir("/proc/self/task")) == 1
    except OSError:
        return False


def end_with_parent(parent: int | None = None) -> None:
    """From now on this process is killed when its parent ends, however that ends.

    Where the system has no signal for this, a thread looks at the number of the parent twice a
    second; it cannot act while a library holds Python's lock.

    Args:
        parent: the process id of the parent, where it may have ended before this call.
    """
    parent = os.getppid() if parent is None else parent
    if not (sys.platform == "linux" and _signal_at_death_of_parent()):
        threading.Thread(target=_watch, args=(parent,), daemon=True).start()
    if os.getppid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)


def _signal_at_death_of_parent() -> bool:
    try:
        return ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0) == 0
    except (OSError, AttributeError):
        return False


def _watch(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(LOOK_EVERY)
    os.kill(os.getpid(), signal.SIGKILL)
