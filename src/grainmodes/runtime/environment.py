"""Environment variables for numba and BLAS: one thread, and a cache folder for this code.

Both libraries read them once, when they are imported, so `prepare` must run before that. Two BLAS
threads beside a second job on two cores can be ten times slower than one thread: hence a fixed
number of threads. numba's cache on disk does not notice an edit in a function that is called from
another file: hence a cache folder that is named by the fingerprint of the kernels.
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


def prepare(processes: int = 1) -> None:
    """Set the threads of a process and NUMBA_CACHE_DIR.

    A process has one thread where the environment sets no number; where it does, as Snakemake does
    for a job, the `processes` of the job share them, so that there are never more.

    MKL_CBWR makes MKL, which PARDISO uses, independent of the alignment of arrays in memory, so
    that the same input gives the same bytes.
    """
    for name in THREAD_VARIABLES:
        given = os.environ.get(name, "1")
        if processes > 1 or not given.strip():
            given = str(max(1, int(given) // processes)) if given.strip().isdigit() else "1"
        os.environ[name] = given
    os.environ.setdefault("MKL_CBWR", "AUTO")
    os.environ["NUMBA_CACHE_DIR"] = str(numba_cache())


def numba_cache() -> Path:
    """The folder of the compiled kernels, named by their fingerprint.

    It lies in NUMBA_CACHE_DIR if that is set, else in the checkout, else in the cache folder of the
    user.
    """
    requested = os.environ.get("NUMBA_CACHE_DIR")
    parent = Path(requested) if requested else _default_parent()
    return parent if parent.name == kernel_hash() else parent / kernel_hash()


def _default_parent() -> Path:
    checkout = PACKAGE.parents[1]
    if (checkout / "pyproject.toml").is_file() and os.access(checkout, os.W_OK):
        return checkout / ".numba_cache"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "grainmodes"
