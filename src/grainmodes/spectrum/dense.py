"""All eigenvalues and modes of a dense matrix, by LAPACK: A (21)–(23).

    J R_n = λ_n R_n,   λ_n = ω_n²

A symmetric J (every s = 0) is solved by divide and conquer, in a tenth of the time of the general
solver: its modes are orthonormal and its eigenvalues real. Eigenvalues carry an absolute error of
about 1e-16 ‖J‖: 1e-6 relative in a rotational band at k_T/k_N = 1e-10.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg

from grainmodes.linalg.failures import finite
from grainmodes.spectrum.eigenproblem import Eigenproblem, Numbers


def eigenvalues(eigenproblem: Eigenproblem) -> Numbers:
    """λ (M,) in k_N d^(1/2), ascending by real part; complex where J is not symmetric.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    matrix = finite(eigenproblem.matrix.toarray())
    if eigenproblem.symmetric:
        return scipy.linalg.eigh(matrix, eigvals_only=True, overwrite_a=True, driver="evd")
    return np.sort_complex(scipy.linalg.eigvals(matrix, overwrite_a=True))


def eigenpairs(eigenproblem: Eigenproblem) -> tuple[Numbers, Numbers]:
    """λ (M,) as from `eigenvalues`, and R (M, M), one normalised column per mode.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    matrix = finite(eigenproblem.matrix.toarray())
    if eigenproblem.symmetric:
        return scipy.linalg.eigh(matrix, overwrite_a=True, driver="evd")
    values, vectors = scipy.linalg.eig(matrix, overwrite_a=True)
    order = np.lexsort((values.imag, values.real))
    return values[order], vectors[:, order]
