"""Atomic writes: a file appears as a whole or not at all, also after a power cut."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from grainmodes.runtime.partial_files import partial_path


@contextmanager
def replaced(path: str | Path) -> Iterator[Path]:
    """A temporary file beside `path` to write into, which is renamed to `path` at the end.

    Missing folders are created. If the body raises, the temporary file is removed, and a file that
    existed under `path` stays as it was. Where `path` is a link, the file that it points to is
    replaced. The content is on the disk before the new name is, and the name before this returns.

    Raises:
        OSError: `path` is neither new nor a regular file, or the disk refuses the file.
    """
    target = writable_target(path)
    partial = partial_path(target)
    own = (None, *map(str, (partial, target, target.parent)))
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        yield partial
        _flush(partial)
        os.replace(partial, target)
        _flush_folder(target.parent)
    except OSError as error:
        if error.errno is None or error.filename not in own:
            raise
        raise OSError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def writable_target(path: str | Path) -> Path:
    """The file that a write to `path` replaces or makes: behind all links.

    Raises:
        OSError: it is neither new nor a regular file, or the links lead to no place.
    """
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise OSError(f"{path}: cannot be written, expected the name of a file, got a folder")
    if target.is_symlink():
        raise OSError(f"{path}: cannot be written, expected a file, got a link to itself")
    if target.exists() and not target.is_file():
        raise OSError(f"{path}: cannot be written, expected a regular file, got a device or a pipe")
    return target


def _flush(path: Path) -> None:
    """Bring the content of a file to the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _flush_folder(path: Path) -> None:
    """Bring the names in a folder to the disk, where the file system can."""
    with suppress(OSError):  # some network file systems refuse this; the file is there all the same
        _flush(path)
