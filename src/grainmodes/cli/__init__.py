"""The command line: every stage of a study as a command, and one sentence for every failure.

This module and `arguments` import nothing heavy, so that help and the light commands answer at
once; what a command needs is imported when it runs.
"""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path

from grainmodes.cli.arguments import parser
from grainmodes.runtime.environment import prepare
from grainmodes.runtime.failures import MACHINE_ERRORS, sentence
from grainmodes.runtime.supervisor import supervised


def main(argv: list[str] | None = None) -> int:
    """Run one command; the exit status is 0, or 1 for a failure, or 2 for bad usage.

    The command of this process runs under a supervisor; one given as `argv` runs here.
    """
    arguments = parser().parse_args(argv)
    return _answered(arguments, _compute if argv else _supervised)


def _supervised(arguments: Namespace) -> int:
    """Run a command in a child process."""
    _check_output(getattr(arguments, "output", None))
    run = partial(_answered, arguments, _compute)
    return supervised(run, f"grainmodes {arguments.name}", outputs_of(arguments))


def _compute(arguments: Namespace) -> int:
    """Run a command in this process."""
    prepare(getattr(arguments, "processes", 1))
    module, _, function = arguments.run.partition(":")
    _check_output(getattr(arguments, "output", None))
    getattr(import_module(f"grainmodes.cli.{module}"), function)(arguments)
    sys.stdout.flush()
    return 0


def _answered(arguments: Namespace, action: Callable[[Namespace], int]) -> int:
    """What an action returns; where it fails, a sentence and the exit status of the failure."""
    try:
        return action(arguments)
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # A reader such as `head` has seen enough; Python would flush the rest when it ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except _mistakes() as error:
        if arguments.debug:
            raise
        print(f"grainmodes {arguments.name}: {sentence(error)}", file=sys.stderr)
        return 1
    return 0


def outputs_of(arguments: Namespace) -> list[Path]:
    """The files that a command writes, links followed; devices and pipes are left out."""
    named = [getattr(arguments, "output", None), *getattr(arguments, "outputs", [])]
    paths = [Path(path).resolve() for path in named if path is not None]
    return [path for path in paths if path.is_file() or not path.exists()]


def _mistakes() -> tuple[type[Exception], ...]:
    """What a user or the machine can cause; imported only once something went wrong."""
    from grainmodes.dataset.files import BlockError

    return BlockError, ValueError, *MACHINE_ERRORS


def _check_output(output: Path | None) -> None:
    """Refuse a place that cannot be written before hours are spent on what goes there."""
    if output is None:
        return
    output.parent.mkdir(parents=True, exist_ok=True)
    if output.is_dir():
        raise OSError(f"{output}: cannot be written, expected the name of a file, got a folder")
    if not os.access(output.parent, os.W_OK):
        raise OSError(
            f"{output}: cannot be written, expected a writable folder, got {output.parent}"
        )
