"""The choice between the sparse factorisations. It is made here only.

SuperLU comes with SciPy and is always available. PARDISO (`pip install grainmodes[pardiso]`) is
five to ten times faster. It gives the same inertia and, to rounding, the same solutions.
"""

from __future__ import annotations

from importlib.util import find_spec

import scipy.sparse as sparse

from grainmodes.linalg.factorisation import Factorisation
from grainmodes.linalg.pardiso import Pardiso
from grainmodes.linalg.superlu import SuperLU
from grainmodes.parameters.factors import PARDISO_FROM


def make_factorisation(pattern: sparse.csc_array, backend: str = "auto") -> Factorisation:
    """A factorisation for symmetric matrices with the entries of `pattern`.

    Args:
        pattern: (M, M) sorted CSC with a symmetric pattern; its values are not read.
        backend: "superlu", "pardiso", or "auto" for the faster one that is installed.

    Raises:
        ValueError: `backend` is unknown, or it is PARDISO and not installed.
    """
    name = choose_backend(backend, pattern.shape[0])
    return Pardiso(pattern) if name == "pardiso" else SuperLU(pattern)


def choose_backend(backend: str, size: int) -> str:
    """The name of the factorisation for a symmetric matrix of `size` rows.

    Raises:
        ValueError: as `make_factorisation`.
    """
    if backend not in ("auto", "superlu", "pardiso"):
        raise ValueError(f"factorisation: expected auto, superlu or pardiso, got {backend!r}")
    installed = find_spec("pypardiso") is not None
    if backend == "auto":
        return "pardiso" if installed and size >= PARDISO_FROM else "superlu"
    if backend == "pardiso" and not installed:
        raise ValueError(
            "factorisation 'pardiso' is not installed: run pip install 'grainmodes[pardiso]', or "
            "choose 'superlu' or 'auto'"
        )
    return backend
