"""The factors of J − σ for a symmetric J: the number of eigenvalues below σ, and (J − σ)⁻¹ b.

Sylvester's law of inertia: S (J − σ) S has as many negative eigenvalues as J has eigenvalues below
σ, whatever the diagonal scaling S. With

    S = diag(s),   s_i = 1 / √max(|J_ii|, |σ_i|)

every row has entries of order one. Rows that are many orders smaller than the others keep their
relative accuracy, and a count is right at λ (1 ± 1e-12) even where λ is far below the rounding of
‖J‖. (An example are the rotational rows of a packing of weakly frictional grains: they are k_T/k_N
times smaller than the translational ones.) Elimination without pivoting, as in SuperLU, keeps this
accuracy at any scale; PARDISO chooses its pivots by size and needs S.

σ may differ from row to row, for counts in two shifts (`spectrum.inertia_counts`).

| symbol | name       | meaning                                 |
| ------ | ---------- | --------------------------------------- |
| J      | matrix     | (M, M) sparse, symmetric                |
| σ      | shift      | float, or (M,) with one value per row   |
| S      | scale      | (M,) its diagonal                       |
| –      | n_below    | number of eigenvalues of J below σ      |
| –      | null_space | (M, Z) known zero modes of J            |
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

from grainmodes.linalg.backends import make_factorisation
from grainmodes.linalg.factorisation import ZeroPivotError

SHIFT_PERTURBATIONS = (0.0, 2e-14, 1e-12, 5e-11, 3e-9)
"""Relative changes of σ, tried one after the other where J − σ, or a part of it that is eliminated
first, is singular to rounding."""


class SymmetricShift:
    """S (J − σ) S, factored at one σ at a time.

    Attributes:
        n_below: number of eigenvalues of J below the σ of the last `factor_at`; 0 before it.
        backend: name of the factorisation, "superlu" or "pardiso".
        null_space: known zero modes of J, (M, Z) float64, orthonormal.

    Args:
        matrix: J, (M, M) sparse, symmetric; rows may be empty.
        backend: "superlu", "pardiso" or "auto", see `backends.make_factorisation`.
        null_space: as the attribute; none by default.

    Raises:
        ValueError: `backend` is unknown or not installed.
    """

    def __init__(
        self,
        matrix: sparse.sparray,
        backend: str = "auto",
        null_space: NDArray[np.float64] | None = None,
    ):
        self._matrix = with_diagonal(matrix)
        self._row = self._matrix.indices
        self._column = np.repeat(np.arange(self.size), np.diff(self._matrix.indptr))
        self._on_diagonal = np.flatnonzero(self._row == self._column)
        self._diagonal_size = np.abs(self._matrix.data[self._on_diagonal])
        self._factors = make_factorisation(self._matrix, backend)
        self.backend = self._factors.name
        self.null_space = np.zeros((self.size, 0)) if null_space is None else null_space
        self.n_below = 0

    @property
    def size(self) -> int:
        """M, the number of rows."""
        return int(self._matrix.shape[0])

    def factor_at(self, shift: float | NDArray[np.float64]) -> SymmetricShift:
        """Factor J − σ at another σ, replacing the factors before; return this object.

        Args:
            shift: σ, one number or one per row (M,). Where J − σ is singular to rounding, σ is
                increased by up to 3e-9 of itself.

        Raises:
            ZeroPivotError: J − σ is singular at each of these σ.
        """
        for change in SHIFT_PERTURBATIONS:
            try:
                self._factor(shift * (1.0 + change))
                return self
            except ZeroPivotError:
                continue
        raise ZeroPivotError(f"J - sigma is singular at sigma = {np.max(shift)}")

    def _factor(self, shift: float | NDArray[np.float64]) -> None:
        shift = np.broadcast_to(shift, self.size)
        larger = np.maximum(self._diagonal_size, np.abs(shift))
        self._scale = 1.0 / np.sqrt(np.where(larger > 0.0, larger, 1.0))
        values = self._matrix.data.copy()
        values[self._on_diagonal] -= shift
        scaled = self._scale[self._row] * values * self._scale[self._column]
        self.n_below = self._factors.refactor(scaled)

    def solve(self, right: NDArray[np.float64]) -> NDArray[np.float64]:
        """(J − σ)⁻¹ b for one or several b, (M,) or (M, K) float64."""
        scale = self._scale if right.ndim == 1 else self._scale[:, None]
        return scale * self._factors.solve(scale * right)


def with_diagonal(matrix: sparse.sparray) -> sparse.csc_array:
    """The matrix (M, M) as sorted CSC that stores every diagonal entry, zero or not."""
    entries, places = matrix.tocoo(), np.arange(matrix.shape[0])
    row, column = (np.concatenate([place, places]) for place in (entries.row, entries.col))
    data = np.concatenate([entries.data, np.zeros(len(places))])
    full = sparse.coo_array((data, (row, column)), shape=matrix.shape).tocsc()
    full.sort_indices()
    return full
