"""What every sparse factorisation of this package offers, and the error that it may raise.

A factorisation is made for one sparsity pattern and serves many sets of values: the pattern is
ordered once, and each new set of values costs a numerical factorisation only. `backends` chooses
between the implementations in `superlu` and `pardiso`.
"""

from __future__ import annotations

from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

Number = TypeVar("Number", bound=np.inexact[Any])
"""float64 or complex128; PARDISO knows float64 alone."""


class ZeroPivotError(ArithmeticError):
    """A pivot vanishes: the matrix is singular to rounding."""


class Factorisation(Protocol):
    """The factors of a matrix A, (M, M), whose sparsity pattern is symmetric and fixed.

    Attributes:
        name: "superlu" or "pardiso".
    """

    name: str

    def refactor(self, values: NDArray[Number]) -> int:
        """Factor A anew and return the number of its negative pivots.

        For a symmetric A this is the number of its negative eigenvalues (Sylvester).

        Args:
            values: (nnz,) entries of A in the order of the pattern, sorted CSC.

        Raises:
            ZeroPivotError: A is singular to rounding, so that its inertia is not known.
        """

    def solve(self, right: NDArray[Number]) -> NDArray[Number]:
        """Solutions x of A x = b, (M,) or (M, K) as `right`."""
