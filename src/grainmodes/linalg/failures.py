"""Which errors are failures of a sample: a numerical method that says that it has no result.

Every other error is one of the machine (no memory, a library that does not load, a full disk) or a
mistake in the code. It ends the job, because the same sample may well have a result.
"""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import ArpackError

from grainmodes.runtime.failures import MachineError

NUMERICAL_ERRORS = (ArithmeticError, np.linalg.LinAlgError, ArpackError)
"""What numerical methods raise; a class of our own for such a failure is an `ArithmeticError`."""

Array = TypeVar("Array", bound=NDArray[Any])


class FactorisationError(MachineError):
    """The library of a factorisation is missing, does not load, or fails by itself."""


def finite(array: Array) -> Array:
    """The array itself.

    Raises:
        ArithmeticError: it holds a NaN or an infinite number; SciPy would raise a ValueError.
    """
    if not np.isfinite(array).all():
        raise ArithmeticError("a matrix: expected finite numbers, got NaN or infinite ones")
    return array
