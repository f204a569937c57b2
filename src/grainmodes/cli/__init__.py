"""The command line: every stage of a study as a command, and one sentence for every failure.

This module and `arguments` import nothing heavy, so that help and the light commands answer at
once; what a command needs is imported when it runs.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module
from pathlib import Path

from grainmodes.cli.arguments import parser
from grainmodes.runtime.environment import prepare
from grainmodes.runtime.failures import MACHINE_ERRORS, sentence


def main(argv: list[str] | None = None) -> int:
    """Run one command; the exit status is 0, or 1 for bad input, or 2 for bad usage."""
    arguments = parser().parse_args(argv)
    prepare()
    module, _, function = arguments.run.partition(":")
    try:
        _check_output(getattr(arguments, "output", None))
        getattr(import_module(f"grainmodes.cli.{module}"), function)(arguments)
        sys.stdout.flush()
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
