"""Direct solution of J u = b for the backbone of a packing.

The two translations are pinned at grain 0 (its x and y, never its rotation). A symmetric J is the
shift 0 of `shift`: scaled rows, factors of one triangle. Any other J is scaled by 1/√|J_ii| on both
sides likewise, since the rotational rows of a weakly frictional packing are k_T/k_N times smaller
than the others and unscaled pivots would bury them, and factored by SuperLU with row pivoting.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from grainmodes.shift import SymmetricShift

SOFTEST = 1e12
"""Largest response of the scaled Jacobian to a generic force that rounding lets one believe."""


class FloppyError(ArithmeticError):
    """The Jacobian has zero modes beyond the translations: no unique response exists."""


class PinnedFactor:
    """The factors of a scaled Jacobian whose first two unknowns are pinned to zero.

    Args:
        matrix: J, (kN, kN) sparse CSC.
        symmetric: J is symmetric: every s = 0.
        backend: the factorisation of a symmetric J.

    Raises:
        FloppyError: the pinned matrix is singular, or so nearly that no digit would be right.
    """

    def __init__(self, matrix: sparse.csc_array, symmetric: bool, backend: str = "auto"):
        self._matrix = matrix[2:, 2:]
        diagonal = np.abs(self._matrix.diagonal())
        if np.any(diagonal == 0.0):
            raise FloppyError("a degree of freedom has no stiffness at all")
        try:
            self._factor = (
                SymmetricShift(self._matrix, backend).to(0.0)
                if symmetric
                else _General(self._matrix, diagonal)
            )
        except (RuntimeError, ArithmeticError) as error:
            raise FloppyError(f"the Jacobian is singular ({error})") from error
        self._probe(np.sqrt(diagonal))

    def _probe(self, root: np.ndarray) -> None:
        """A zero mode beyond the pinned ones answers any generic force beyond all bounds."""
        force = np.random.default_rng(0).standard_normal(len(root))
        answer = root * self._factor.solve(root * force)
        if not np.linalg.norm(answer) < SOFTEST * np.linalg.norm(force):
            raise FloppyError("the Jacobian has zero modes beyond the two translations")

    def solve(self, force: np.ndarray) -> np.ndarray:
        """u with J u = `force`, (kN,); one step of refinement; u of grain 0 is zero in x, y."""
        wanted = force.ravel()[2:]
        free = self._factor.solve(wanted)
        free += self._factor.solve(wanted - self._matrix @ free)
        return np.concatenate([np.zeros(2), free])


class _General:
    """Factors of a matrix that need not be symmetric."""

    def __init__(self, matrix: sparse.csc_array, diagonal: np.ndarray):
        self._scale = 1.0 / np.sqrt(diagonal)
        scaling = sparse.dia_array((self._scale[None, :], [0]), shape=matrix.shape)
        scaled = (scaling @ matrix @ scaling).tocsc()
        self._factors = splu(scaled, permc_spec="COLAMD", diag_pivot_thresh=1.0)

    def solve(self, force: np.ndarray) -> np.ndarray:
        return self._scale * self._factors.solve(self._scale * force)
