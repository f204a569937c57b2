"""The factors of J − σ for a symmetric J: how many eigenvalues lie below σ, and (J − σ)⁻¹ b.

Sylvester: the number of negative eigenvalues of S (J − σ) S does not depend on the scaling S, and
is the number of eigenvalues of J below σ. With

    S = diag(s),   s_i = 1 / √max(|J_ii|, |σ_i|)

every row has entries of order one: the rotational rows of a weakly frictional packing, k_T/k_N
times smaller than the others, keep their relative accuracy, and a count is right at λ (1 ± 1e-12)
even where λ is far below the rounding of ‖J‖. Elimination without pivoting, as in SuperLU, keeps it
at any scale; PARDISO chooses its pivots by size and needs S.

σ may differ from row to row, for counts in two shifts (`spectrum.counting`).
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from grainmodes.linalg.factorisation import ZeroPivotError, factorisation

NUDGES = (0.0, 2e-14, 1e-12, 5e-11, 3e-9)
"""Relative steps off a shift that is an eigenvalue of J, or of the part of J eliminated so far, to
rounding."""


class SymmetricShift:
    """S (J − σ) S, factored at one σ at a time.

    Attributes:
        count: number of eigenvalues of J below σ.
        name: the factorisation at work.
        null: known zero modes of J, (M, Z), orthonormal.

    Args:
        matrix: J, (M, M) sparse, symmetric; each row may be empty.
        backend: see `factorisation`.
    """

    def __init__(
        self, matrix: sparse.csc_array, backend: str = "auto", null: np.ndarray | None = None
    ):
        self._matrix = with_diagonal(matrix)
        self._row = self._matrix.indices
        self._column = np.repeat(np.arange(self.size), np.diff(self._matrix.indptr))
        self._on_diagonal = np.flatnonzero(self._row == self._column)
        self._stiffness = np.abs(self._matrix.data[self._on_diagonal])
        self._factors = factorisation(self._matrix, backend)
        self.name = self._factors.name
        self.null = np.zeros((self.size, 0)) if null is None else null
        self.count = 0

    @property
    def size(self) -> int:
        """M, the number of degrees of freedom."""
        return self._matrix.shape[0]

    def to(self, shift: float | np.ndarray) -> SymmetricShift:
        """Factor at another σ, a number or one per row (M,); the factors before are gone.

        Raises:
            ZeroPivotError: the matrix stays singular however the shift is nudged.
        """
        for step in NUDGES:
            try:
                self._factor(shift * (1.0 + step))
                return self
            except ZeroPivotError:
                continue
        raise ZeroPivotError(f"J - sigma is singular at sigma = {np.max(shift)}")

    def _factor(self, shift: float | np.ndarray) -> None:
        shift = np.broadcast_to(shift, self.size)
        larger = np.maximum(self._stiffness, np.abs(shift))
        self._scale = 1.0 / np.sqrt(np.where(larger > 0.0, larger, 1.0))
        values = self._matrix.data.copy()
        values[self._on_diagonal] -= shift
        scaled = self._scale[self._row] * values * self._scale[self._column]
        self.count = self._factors.refill(scaled)

    def solve(self, right: np.ndarray) -> np.ndarray:
        """(J − σ)⁻¹ b for one or several b, (M,) or (M, K)."""
        scale = self._scale if right.ndim == 1 else self._scale[:, None]
        return scale * self._factors.solve(scale * right)


def with_diagonal(matrix: sparse.sparray) -> sparse.csc_array:
    """The matrix with a place for every diagonal entry, also where its row is empty."""
    entries, every = matrix.tocoo(), np.arange(matrix.shape[0])
    row, column = (np.concatenate([place, every]) for place in (entries.row, entries.col))
    data = np.concatenate([entries.data, np.zeros(len(every))])
    full = sparse.coo_array((data, (row, column)), shape=matrix.shape).tocsc()
    full.sort_indices()
    return full
