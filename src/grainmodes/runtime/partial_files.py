"""Files that are being written, `.NAME.MARK.partial`, and what killed processes leave of them.

MARK names the system and the process that writes (`runtime.processes`).
"""

from __future__ import annotations

import glob
import re
from pathlib import Path

from grainmodes.runtime.processes import Process, start_of

UNTOUCHED = 3600.0
"""Seconds after which a file that a process elsewhere was writing is not written any more."""

MARK = re.compile(r"\.(?P<system>[0-9a-f]{8})-(?P<number>\d+)-(?P<start>[\d.]*)\.partial$")


def partial_path(path: Path) -> Path:
    """Where this process writes a file that will be renamed to `path`."""
    return path.with_name(f".{path.name}.{Process.current().mark}.partial")


def remove_partial_files_of(path: Path) -> None:
    """Remove what killed processes left of a file that only this process may write.

    So it does of the checkpoints beside it.
    """
    name = glob.escape(path.name)
    for pattern in (f".{name}.*.partial", f"..{name}.*.checkpoint.*.partial"):
        for file in path.parent.glob(pattern):
            if _writer_is_gone(file) is not False:
                file.unlink(missing_ok=True)


def remove_partial_files_in(folder: Path, now: float) -> None:
    """Remove what killed processes left anywhere in a folder.

    Args:
        now: when something was last written there, s, in the time of its file system.
    """
    for file in folder.rglob(".*.partial"):
        gone = _writer_is_gone(file)
        if gone or (gone is None and now - file.stat().st_mtime > UNTOUCHED):
            file.unlink(missing_ok=True)


def _writer_is_gone(file: Path) -> bool | None:
    """Whether the process that wrote a partial file has ended; None if it was on another system."""
    mark = MARK.search(file.name)
    if mark is None or not Process.current().mark.startswith(mark["system"]):
        return None
    return start_of(int(mark["number"])) != mark["start"]
