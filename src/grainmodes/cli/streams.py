"""Standard output: what a terminal cannot show, and a reader that goes away."""

from __future__ import annotations

import io
import os
import select
import signal
import sys

READER_GONE = 128 + signal.SIGPIPE
"""Exit status of a command whose reader has seen enough, as a shell reports it of `cat`."""


def escape_unknown_characters() -> None:
    """Write characters that the encoding of a terminal lacks as their code, such as \\u03c9."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def reader_is_gone() -> bool:
    """Whether standard output is a pipe whose reader, such as `head`, has ended."""
    try:
        poll = select.poll()
        poll.register(sys.stdout.fileno(), 0)
        return any(event & select.POLLERR for _, event in poll.poll(0))
    except (AttributeError, OSError, ValueError):  # there is no standard output, or it is no file
        return False


def write_out() -> None:
    """Write out what was printed.

    Raises:
        OSError: it cannot be written; BrokenPipeError where the reader is gone.
    """
    try:
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        raise
    except OSError:
        discard()
        raise


def discard() -> None:
    """Let go of what cannot be written: Python would write it when it ends, and fail again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
