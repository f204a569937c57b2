"""Atomic writes: a file appears as a whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from grainmodes.runtime.partial_files import partial_path


@contextmanager
def replaced(path: str | Path) -> Iterator[Path]:
    """A temporary file beside `path` to write into, which is renamed to `path` at the end.

    Missing folders are created. If the body raises, the temporary file is removed, and a file that
    existed under `path` stays as it was.

    Raises:
        OSError: the folder cannot be created, or the file cannot be renamed.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = partial_path(path)
    try:
        yield partial
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)
