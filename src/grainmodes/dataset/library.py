"""The netCDF library: loaded without the locks of HDF5, and used by one thread at a time.

HDF5 asks the file system for a lock on every file that it opens. File systems without locks (NFS,
Lustre) refuse, and then no file can be read or written. Nothing here needs the locks: a file
appears whole, by a rename, and is never changed afterwards. The library is not safe for threads:
two calls at a time crash the process.
"""

from __future__ import annotations

import os
import sys
import threading

VARIABLE = "HDF5_USE_FILE_LOCKING"
"""The environment variable that HDF5 reads when it is loaded."""

if "netCDF4" not in sys.modules:
    os.environ.setdefault(VARIABLE, "FALSE")

LOCKS_FILES = os.environ.get(VARIABLE, "TRUE").upper() not in ("FALSE", "0")
"""Whether HDF5 asks for locks: the user wants it, or has loaded netCDF4 before this package."""

import netCDF4  # noqa: E402

LOCK = threading.RLock()
"""Held during every call of the library."""


def is_refusal(error: Exception) -> bool:
    """Whether an error is one of the library or of the file system, and no mistake in the code."""
    library = str(error).startswith("NetCDF: ")
    return library or isinstance(error, OSError | RuntimeError | UnicodeDecodeError)


__all__ = ["LOCK", "LOCKS_FILES", "VARIABLE", "is_refusal", "netCDF4"]
