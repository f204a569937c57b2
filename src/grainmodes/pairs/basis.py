"""Nearly the eigenvectors of K as a real basis, in single precision, with its factors.

| symbol      | name    | shape                                                          |
| ----------- | ------- | -------------------------------------------------------------- |
| V           | vectors | (M, M), columns of norm 1: u, or for a pair Re u and then Im u |
| their norms | size    | (M,): Im u may be tiny against Re u                            |
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg


class Basis(NamedTuple):
    """V and its factors."""

    vectors: np.ndarray
    size: np.ndarray
    factors: tuple[np.ndarray, np.ndarray]

    @classmethod
    def of(cls, vectors: np.ndarray) -> Basis:
        """The basis of vectors (M, M) of any norm."""
        size = np.linalg.norm(vectors, axis=0)
        columns = (vectors / size).astype(np.float32)
        return cls(columns, size, scipy.linalg.lu_factor(columns))

    def columns(self, at: np.ndarray) -> np.ndarray:
        """Vectors (M, K) in double precision, with their norms."""
        return self.vectors[:, at].astype(float) * self.size[at]

    def rows(self, at: np.ndarray) -> np.ndarray:
        """Rows of V⁻¹ with these norms, as columns (M, K): left vectors."""
        unit = np.zeros((len(self.size), len(at)), np.float32)
        unit[at, np.arange(len(at))] = 1.0
        return self.combined_rows(unit).astype(float) / self.size[at]

    def combined_rows(self, coordinates: np.ndarray) -> np.ndarray:
        """V⁻ᵀ c of coordinates (M, K) in columns of norm 1."""
        return scipy.linalg.lu_solve(self.factors, coordinates.astype(np.float32), trans=1)

    def coordinates(self, field: np.ndarray) -> np.ndarray:
        """V⁻¹ f of fields (M, K), in columns of norm 1."""
        return scipy.linalg.lu_solve(self.factors, field.astype(np.float32))

    def products(self, field: np.ndarray) -> np.ndarray:
        """Vᵀ f of fields (M, K), with columns of norm 1."""
        return self.vectors.T @ field.astype(np.float32)
