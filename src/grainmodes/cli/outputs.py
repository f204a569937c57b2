"""The files that a command writes, looked at before hours are spent on what goes into them."""

from __future__ import annotations

import os
from argparse import Namespace
from pathlib import Path

from grainmodes.parameters.figures import files_of_stem
from grainmodes.runtime.atomic import writable_target

OPTIONS = ("output", "outputs")
"""Arguments that name what is written; every other path is read."""


def check(arguments: Namespace) -> list[Path]:
    """The files that a command writes, behind all links, if it may write each of them.

    Raises:
        OSError: an output is no regular file, is read-only, lies in a folder that cannot be
            written, stands twice, or is a file that the command reads, also through links.
    """
    outputs = outputs_of(arguments)
    targets = [writable_target(output) for output in outputs]
    inputs = [path for path in _paths(arguments, read=True) if path.exists()]
    for output, target in zip(outputs, targets, strict=True):
        for given in inputs:
            if target.exists() and target.samefile(given):
                raise OSError(f"{output}: cannot be written, the command reads it as {given}")
        if targets.count(target) > 1:
            raise OSError(f"{output}: expected every output once, got it twice")
        if target.exists() and not os.access(target, os.W_OK):
            raise OSError(f"{output}: cannot be written, the file is read-only")
    for output, target in zip(outputs, targets, strict=True):
        folder = target.parent
        folder.mkdir(parents=True, exist_ok=True)
        if not os.access(folder, os.W_OK):
            raise OSError(f"{output}: cannot be written, expected a writable folder, got {folder}")
    return targets


def outputs_of(arguments: Namespace) -> list[Path]:
    """Every file that a command writes: of a figure one for each form."""
    named = _paths(arguments, read=False)
    if hasattr(arguments, "figure"):
        return [path for stem in named for path in files_of_stem(stem)]
    return named


def _paths(arguments: Namespace, read: bool) -> list[Path]:
    """The paths among the arguments that are read, or those that are written."""
    found: list[Path] = []
    for name, value in vars(arguments).items():
        if (name in OPTIONS) != read:
            values = value if isinstance(value, list) else [value]
            found += [item for item in values if isinstance(item, Path)]
    return found
