"""The choice between the sparse factorisations. It is made here only.

SuperLU comes with SciPy and is always available. PARDISO (`pip install grainmodes[pardiso]`) is
five to ten times faster. It gives the same inertia and, to rounding, the same solutions. Where it
is installed and does not load, "auto" is an error too: the last digits of a result must not depend
on whether a library could be loaded this time.
"""

from __future__ import annotations

import scipy.sparse as sparse

from grainmodes.linalg.factorisation import Factorisation
from grainmodes.linalg.pardiso import Pardiso
from grainmodes.linalg.superlu import SuperLU
from grainmodes.parameters.factors import PARDISO_FROM
from grainmodes.runtime import pardiso


def make_factorisation(pattern: sparse.csc_array, backend: str = "auto") -> Factorisation:
    """A factorisation for symmetric matrices with the entries of `pattern`.

    Args:
        pattern: (M, M) sorted CSC with a symmetric pattern; its values are not read.
        backend: "superlu", "pardiso", or "auto" for the faster one that is installed.

    Raises:
        ValueError: `backend` is unknown.
        FactorisationError: PARDISO is chosen, by its name or because it is installed, and it is
            missing or does not load.
    """
    name = choose_backend(backend, pattern.shape[0])
    return Pardiso(pattern) if name == "pardiso" else SuperLU(pattern)


def choose_backend(backend: str, size: int) -> str:
    """The name of the factorisation for a symmetric matrix of `size` rows.

    Raises:
        ValueError: it is unknown.
    """
    if backend not in ("auto", "superlu", "pardiso"):
        raise ValueError(f"factorisation: expected auto, superlu or pardiso, got {backend!r}")
    if backend == "auto":
        return "pardiso" if pardiso.is_installed() and size >= PARDISO_FROM else "superlu"
    return backend
