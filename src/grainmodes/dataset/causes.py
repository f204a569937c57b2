"""Why a file cannot be read or written, in words: HDF5 says "HDF error" whatever it is."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

from grainmodes.dataset import library

SIGNATURE = b"\x89HDF\r\n\x1a\n"

HEAD = 64
"""Bytes at the start of a file that are looked at; no HDF5 file is shorter."""

PROBE = 2**20
"""Bytes that a disk must still take to be no cause."""


def why_unreadable(path: Path, error: Exception) -> str:
    """The cause of an error of the library on a file that exists."""
    try:
        with path.open("rb") as file:
            head, size = file.read(HEAD), os.fstat(file.fileno()).st_size
            cause = _refused_lock(file.fileno())
    except OSError as refusal:
        return str(refusal.strerror)
    if cause:
        return cause
    if not head:
        return "it is empty"
    if not head.startswith(SIGNATURE[: len(head)]):
        return "it is no netCDF-4 file"
    expected = _stated_size(head)
    if expected > size:
        return f"truncated, expected {expected} bytes, got {size}"
    return f"damaged ({' '.join(str(error).split())})"


def _refused_lock(descriptor: int) -> str:
    """Why HDF5 gets no lock on a file; nothing where it gets one, or does not ask for one."""
    if not library.LOCKS_FILES:
        return ""
    advice = f"set {library.VARIABLE}=FALSE before netCDF4 is imported"
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return f"another process has locked it; {advice}"
    except OSError as refusal:
        return f"its file system refuses a lock ({refusal.strerror}); {advice}"
    return ""


def _stated_size(head: bytes) -> int:
    """The size that the superblock of an HDF5 file states; 0 where it cannot be read.

    Format Specification Version 3.0, Sec. II.A: the address of the end of the file.
    """
    if len(head) < HEAD:
        return HEAD
    version = head[8]
    width, place = (head[9], 28) if version > 1 else (head[13], 40 + 4 * version)
    return int.from_bytes(head[place : place + width], "little") if width == 8 else 0


def why_unwritable(partial: Path, error: Exception) -> str:
    """The cause of an error of the library while it wrote a file: what the disk says by itself."""
    try:
        with partial.open("ab") as file:
            file.write(b"\0" * PROBE)
            file.flush()
            os.fsync(file.fileno())
    except OSError as refusal:
        return str(refusal.strerror)
    return " ".join(str(error).split())
