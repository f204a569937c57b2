"""Direct solution of J u = b for the backbone of a packing.

J is scaled by S = 1/√|J_ii| on both sides before it is factored: the rotational rows of a weakly
frictional packing are k_T/k_N times smaller than the others, and unscaled pivots would bury them.
The two translations are pinned at grain 0 (its x and y, never its rotation).
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

SYMMETRIC = {
    "permc_spec": "MMD_AT_PLUS_A",
    "diag_pivot_thresh": 0.0,
    "options": {"SymmetricMode": True},
}
GENERAL = {"permc_spec": "COLAMD", "diag_pivot_thresh": 1.0}


SOFTEST = 1e12
"""Largest response of the scaled Jacobian to a generic force that rounding lets one believe."""


class FloppyError(ArithmeticError):
    """The Jacobian has zero modes beyond the translations: no unique response exists."""


class PinnedFactor:
    """The factors of a scaled Jacobian whose first two unknowns are pinned to zero.

    Args:
        matrix: J, (kN, kN) sparse CSC.
        symmetric: whether to use symmetric pivoting (J symmetric: every s = 0).

    Raises:
        FloppyError: the pinned matrix is singular, or so nearly that no digit would be right.
    """

    def __init__(self, matrix: sparse.csc_array, symmetric: bool):
        self._size = matrix.shape[0]
        self._matrix = matrix[2:, 2:]
        diagonal = np.abs(self._matrix.diagonal())
        if np.any(diagonal == 0.0):
            raise FloppyError("a degree of freedom has no stiffness at all")
        self._scale = 1.0 / np.sqrt(diagonal)
        scaled = sparse.dia_array((self._scale[None, :], [0]), shape=self._matrix.shape)
        try:
            self._factor = splu(
                (scaled @ self._matrix @ scaled).tocsc(), **(SYMMETRIC if symmetric else GENERAL)
            )
        except RuntimeError as error:
            raise FloppyError(f"the Jacobian is singular ({error})") from error
        self._probe()

    def _probe(self) -> None:
        """A zero mode beyond the pinned ones answers any generic force beyond all bounds."""
        force = np.random.default_rng(0).standard_normal(len(self._scale))
        answer = self._factor.solve(force)
        if not np.linalg.norm(answer) < SOFTEST * np.linalg.norm(force):
            raise FloppyError("the Jacobian has zero modes beyond the two translations")

    def solve(self, force: np.ndarray) -> np.ndarray:
        """u with J u = `force`, (kN,); one step of refinement; u of grain 0 is zero in x, y."""
        wanted = force.ravel()[2:]
        free = self._apply(wanted)
        free += self._apply(wanted - self._matrix @ free)
        return np.concatenate([np.zeros(2), free])

    def _apply(self, force: np.ndarray) -> np.ndarray:
        return self._scale * self._factor.solve(self._scale * force)
