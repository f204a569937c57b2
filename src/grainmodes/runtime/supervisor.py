"""A command runs in a child of a process that only looks after it.

The supervisor never computes, so that it answers to a signal at once, however long a library keeps
the child busy. It

- passes signals on to the child, and says by which signal it was ended;
- ends the child when the workflow that started the command is gone (`WORKFLOW`);
- holds claims of the output files, and shows that their owner lives (`runtime.claims`);
- removes what a killed child leaves of them.

Where the supervisor itself is killed, its child and the processes of that end with it.
"""

from __future__ import annotations

import json
import os
import select
import signal
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from grainmodes.runtime import claims
from grainmodes.runtime.partial_files import remove_partial_files_of
from grainmodes.runtime.processes import LOOK_EVERY, Process, end_with_parent

WORKFLOW = "GRAINMODES_WORKFLOW"
"""Environment variable that names the process that runs the workflow, for all of its jobs."""

PASSED_ON = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Signals that end a command."""


def supervised(run: Callable[[], int], name: str, outputs: Sequence[Path]) -> int:
    """The exit status of `run`, which runs in a child; 128 + n if signal n has ended it.

    Args:
        name: of the command, for messages.
        outputs: files that `run` writes. If another command writes one of them, wait for its end.

    Raises:
        OSError: the claim of an output cannot be written.
    """

    def tell(sentence: str) -> None:
        print(f"{name}: {sentence}", file=sys.stderr, flush=True)

    held: list[claims.Claim] = []
    received: list[int] = []
    try:
        for path in outputs:
            claim = path.with_name(f".{path.name}.claim")
            held.append(claims.take(claim, f"{path}: to be written", wait=True, tell=tell))
            remove_partial_files_of(path)
        child, pipe = _fork()
        if not child:
            held, outputs = [], []  # they belong to the supervisor
            return run()
        status = _look_after(child, pipe, held, received, tell)
    finally:
        for path, one in zip(outputs, held, strict=False):
            remove_partial_files_of(path)
            one.release()
    if received:
        signal.signal(received[0], signal.SIG_DFL)
        os.kill(os.getpid(), received[0])
    return status


def workflow() -> Process | None:
    """The process that runs the workflow which this command belongs to, if it can be seen here."""
    try:
        process = Process(**json.loads(os.environ[WORKFLOW]))
    except (KeyError, ValueError, TypeError):
        return None
    return process if process.is_here else None


def _fork() -> tuple[int, int]:
    """The number of the child, 0 in it, and the end of a pipe that closes when the child ends."""
    reading, writing = os.pipe()
    parent, signals = os.getpid(), [s for s in PASSED_ON if signal.getsignal(s) != signal.SIG_IGN]
    signal.pthread_sigmask(signal.SIG_BLOCK, PASSED_ON)
    child = os.fork()
    if child:
        os.close(writing)
        return child, reading
    os.close(reading)
    end_with_parent(parent)
    for number in signals:
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, PASSED_ON)
    return 0, writing


def _look_after(
    child: int,
    pipe: int,
    held: Sequence[claims.Claim],
    received: list[int],
    tell: Callable[[str], None],
) -> int:
    """The exit status of a child, once it has ended; appends the signals that came meanwhile."""

    def pass_on(number: int, frame: object) -> None:
        received.append(number)
        os.kill(child, number)

    for number in PASSED_ON:
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, pass_on)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, PASSED_ON)
    owner, touched, orphan = workflow(), time.monotonic(), False
    while True:
        select.select([pipe], [], [], LOOK_EVERY)
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            break
        if owner and owner.is_gone:
            orphan = True
            os.kill(child, signal.SIGKILL)
        if time.monotonic() - touched > claims.BEAT:
            touched = time.monotonic()
            for claim in held:
                claim.touch()
    code = os.waitstatus_to_exitcode(status)
    if code >= 0:
        return code
    if orphan:
        tell(f"ended, because the workflow that started it has ended ({owner})")
    else:
        number = signal.Signals(-code)
        tell(f"ended by {number.name}{HINTS.get(number, '')}; {NOTHING}")
    return 128 - code


NOTHING = "no half-written file is left, and it can be run again"
HINTS = {
    signal.SIGKILL: ", which the system sends where memory is short",
    signal.SIGSEGV: ", which a library got, perhaps because memory is short",
    signal.SIGABRT: ", which a library sent, perhaps because memory is short",
}
