"""The process before numba and BLAS wake up: one thread, and a cache that belongs to the code.

Both are read from the environment once, at import, so `prepare` must run before either library is
imported. Two BLAS threads beside a second job on two cores can be ten times slower than one, and
numba's cache on disk does not notice an edit in a called function of another file: hence a pinned
number of threads, and a cache folder named by the fingerprint of the kernels.
"""

from __future__ import annotations

import os
from pathlib import Path

from grainmodes.runtime.provenance import PACKAGE, kernel_hash

THREAD_VARIABLES = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "NUMBA_NUM_THREADS",
)


def prepare() -> None:
    """Pin the threads that the environment leaves open, and set NUMBA_CACHE_DIR.

    MKL, where PARDISO is installed, takes one branch of its code whatever the alignment of arrays,
    so that the same input gives the same bytes.
    """
    for name in THREAD_VARIABLES:
        os.environ.setdefault(name, "1")
    os.environ.setdefault("MKL_CBWR", "AUTO")
    os.environ["NUMBA_CACHE_DIR"] = str(numba_cache())


def numba_cache() -> Path:
    """Folder of the compiled kernels, named by their fingerprint.

    It lies where NUMBA_CACHE_DIR says, else in the checkout, else in the user's cache folder.
    """
    asked = os.environ.get("NUMBA_CACHE_DIR")
    parent = Path(asked) if asked else _default_parent()
    return parent if parent.name == kernel_hash() else parent / kernel_hash()


def _default_parent() -> Path:
    checkout = PACKAGE.parents[1]
    if (checkout / "pyproject.toml").is_file() and os.access(checkout, os.W_OK):
        return checkout / ".numba_cache"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "grainmodes"
