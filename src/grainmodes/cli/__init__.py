"""The command line: every stage of a study as a command, and one sentence for every failure.

This module and `arguments` import nothing heavy, so that help and the light commands answer at
once; what a command needs is imported when it runs.
"""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Callable
from functools import partial
from importlib import import_module

from grainmodes.cli import outputs, streams
from grainmodes.cli.arguments import parser
from grainmodes.runtime.environment import prepare
from grainmodes.runtime.failures import MACHINE_ERRORS, sentence
from grainmodes.runtime.supervisor import supervised


def main(argv: list[str] | None = None) -> int:
    """Run one command.

    The exit status is 0, or 1 for a failure, or 2 for bad usage, or 141, as that of `cat`, where
    the reader of the standard output has seen enough. The command of this process runs under a
    supervisor; one given as `argv` runs here.
    """
    streams.escape_unknown_characters()
    try:
        arguments = parser().parse_args(argv)
    except SystemExit:
        if streams.reader_is_gone():
            streams.discard()
            return streams.READER_GONE
        raise
    return _answered(arguments, _compute if argv else _supervised)


def _supervised(arguments: Namespace) -> int:
    """Run a command in a child process."""
    written = outputs.check(arguments)
    run = partial(_answered, arguments, _compute)
    return supervised(run, f"grainmodes {arguments.name}", written)


def _compute(arguments: Namespace) -> int:
    """Run a command in this process."""
    prepare(getattr(arguments, "processes", 1))
    module, _, function = arguments.run.partition(":")
    outputs.check(arguments)
    getattr(import_module(f"grainmodes.cli.{module}"), function)(arguments)
    streams.write_out()
    return 0


def _answered(arguments: Namespace, action: Callable[[Namespace], int]) -> int:
    """What an action returns; where it fails, a sentence and the exit status of the failure."""
    try:
        return action(arguments)
    except KeyboardInterrupt:
        return 130
    except _mistakes() as error:
        if isinstance(error, BrokenPipeError) and streams.reader_is_gone():
            streams.discard()
            return streams.READER_GONE
        if arguments.debug:
            raise
        reason = sentence(error) if isinstance(error, MACHINE_ERRORS) else str(error)
        print(f"grainmodes {arguments.name}: {reason}", file=sys.stderr)
        return 1


def _mistakes() -> tuple[type[Exception], ...]:
    """What a user or the machine can cause; imported only once something went wrong."""
    from grainmodes.dataset.files import BlockError

    return BlockError, ValueError, *MACHINE_ERRORS
