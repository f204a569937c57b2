"""The eigenproblem J R_n = λ_n R_n of a packing: J of its backbone, or of all its grains; A (18).

| symbol | name   | shape, type                    | unit         |
| ------ | ------ | ------------------------------ | ------------ |
| J      | matrix | (M, M) sparse CSC, float64     | k_N d^(1/2)  |
| k      | k      | int: 3 for (x, y, ℓ), else 2   | 1            |
| M = kN | size   | int                            | 1            |
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing, backbone

Numbers = NDArray[np.inexact[Any]]
"""float64 where J is symmetric, otherwise complex128."""

GERSHGORIN_MARGIN = 1.0001
"""Factor that lifts Gershgorin's bound clear of the largest eigenvalue and of its rounding."""


@dataclass(frozen=True)
class Eigenproblem:
    """A sparse matrix (M, M) in k_N d^(1/2), with k rows per grain: (x, y), or (x, y, ℓ)."""

    matrix: sparse.csc_array
    k: int
    symmetric: bool

    @classmethod
    def from_packing(
        cls,
        packing: Packing,
        interaction: Interaction,
        threshold: int = 2,
        keep_rattlers: bool = False,
    ) -> Eigenproblem:
        """J of a packing: A (18).

        Args:
            threshold: a grain with at most so many contacts is a rattler.
            keep_rattlers: whether the rattlers stay in J.

        Raises:
            PackingError: two grains lie at the same place.
        """
        grains = packing if keep_rattlers else backbone(packing, threshold)
        contacts = grains.contacts
        matrix = jacobian(grains, interaction)
        k = matrix.shape[0] // max(grains.n, 1) if grains.n else 3
        return cls(matrix, k, symmetric=contacts.spring_state is None)

    @property
    def size(self) -> int:
        """M, the number of modes."""
        return int(self.matrix.shape[0])

    @property
    def bound(self) -> float:
        """A number above every |λ|, in k_N d^(1/2) (Gershgorin); 0 for an empty matrix."""
        rows = np.abs(self.matrix).sum(axis=1)
        return GERSHGORIN_MARGIN * float(rows.max(initial=0.0))

    @property
    def translations(self) -> NDArray[np.float64]:
        """The two zero modes of every J, (M, 2), orthonormal."""
        along = np.zeros((self.size, 2))
        for axis in range(2):
            along[axis :: self.k, axis] = np.sqrt(self.k / max(self.size, 1))
        return along

    def symmetric_shift(self, backend: str = "auto") -> SymmetricShift:
        """J − σ for a symmetric J, with the translations as its known zero modes.

        Raises:
            ValueError: `backend` is unknown or not installed.
        """
        return SymmetricShift(self.matrix, backend, self.translations)
