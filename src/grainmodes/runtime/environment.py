"""Environment variables for numba and BLAS: one thread, and a cache folder for this code.

Both libraries read them once, when they are imported, so `prepare` must run before that. Two BLAS
threads beside a second job on two cores can be ten times slower than one thread: hence a fixed
number of threads. numba's cache on disk does not notice an edit in a function that is called from
another file: hence a cache folder that is named by the fingerprint of the kernels.
"""

from __future__ import annotations

import os
import stat
import sys
import tempfile
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
    """Set the threads of a process.

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


def numba_cache() -> Path:
    """A folder for the compiled kernels that can be written, named by their fingerprint.

    It lies in NUMBA_CACHE_DIR if that is set, else in the checkout, else in the cache folder of the
    user. Where none can be written it lies among the temporary files, and one sentence says so;
    processes that this one starts find it in NUMBA_CACHE_DIR.
    """
    folders = [_named(parent) for parent in _parents()]
    found = next(filter(_is_writable, folders), None)
    if found is None:
        found = _named(_temporary_parent())
        os.environ["NUMBA_CACHE_DIR"] = str(found)
        tried = " and ".join(map(str, folders)) or "no folder"
        print(
            f"grainmodes: expected a writable folder for compiled kernels, got {tried}; "
            f"they are kept in {found}",
            file=sys.stderr,
        )
    return found


def _named(parent: Path) -> Path:
    return parent if parent.name == kernel_hash() else parent / kernel_hash()


def _parents() -> list[Path]:
    """Where compiled kernels may lie, the first choice first."""
    requested = os.environ.get("NUMBA_CACHE_DIR")
    if requested:
        return [Path(requested)]
    checkout = PACKAGE.parents[1]
    of_checkout = [checkout / ".numba_cache"] if (checkout / "pyproject.toml").is_file() else []
    caches = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return [*of_checkout, *([Path(caches) / "grainmodes"] if Path(caches).is_absolute() else [])]


def _is_writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def _temporary_parent() -> Path:
    """A folder of this user alone, since whoever writes a compiled kernel decides what it does.

    Raises:
        OSError: no folder for temporary files can be written.
    """
    shared = Path(tempfile.gettempdir()) / f"grainmodes-{os.getuid()}"
    try:
        shared.mkdir(mode=0o700, exist_ok=True)
        status = shared.lstat()
    except OSError:
        return Path(tempfile.mkdtemp(prefix="grainmodes-"))
    private = stat.S_ISDIR(status.st_mode) and not status.st_mode & 0o022
    if private and status.st_uid == os.getuid() and _is_writable(shared):
        return shared
    return Path(tempfile.mkdtemp(prefix="grainmodes-"))
