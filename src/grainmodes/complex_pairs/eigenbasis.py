"""Nearly the eigenvectors of K as a real basis, in single precision, with its inverse.

| symbol      | name    | shape                                                          |
| ----------- | ------- | -------------------------------------------------------------- |
| V           | vectors | (M, M), columns of norm 1: u, or for a pair Re u and then Im u |
| their norms | size    | (M,): Im u may be tiny against Re u                            |
| V⁻¹         | inverse | (M, M), its rows the left vectors                              |
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import lapack

BLOCK = 256
"""Columns that LAPACK inverts at once: `scipy.linalg.inv` takes a fifth longer."""


class Basis(NamedTuple):
    """V and V⁻¹."""

    vectors: np.ndarray
    size: np.ndarray
    inverse: np.ndarray

    @classmethod
    def of(cls, vectors: np.ndarray) -> Basis:
        """The basis of vectors (M, M) of any norm."""
        size = np.linalg.norm(vectors, axis=0)
        columns = (vectors / size).astype(np.float32)
        factors, pivots, _ = lapack.sgetrf(columns.T)
        inverse, _ = lapack.sgetri(factors, pivots, lwork=BLOCK * len(size))
        return cls(columns, size, inverse.T)

    def with_units(self, new: np.ndarray) -> Basis:
        """The basis in M coordinates, (M,) bool the new ones, with a unit vector for each."""
        if not new.any():
            return self
        vectors = np.zeros((len(new), len(new)), np.float32)
        size = len(self.size)
        vectors[~new, :size] = self.vectors
        vectors[np.flatnonzero(new), np.arange(size, len(new))] = 1.0
        return Basis.of(vectors)

    def without(self, gone: np.ndarray) -> Basis:
        """The basis without coordinates, (M,) bool, and the vectors that live there most."""
        if not gone.any():
            return self
        there = np.linalg.norm(self.vectors[gone], axis=0)
        kept = np.sort(np.argsort(there, kind="stable")[: -int(gone.sum())])
        return Basis.of(self.vectors[np.ix_(~gone, kept)])

    def columns(self, at: np.ndarray) -> np.ndarray:
        """Vectors in double precision as rows: for places of any shape (...), (..., M)."""
        return self.vectors.T[at].astype(float)

    def rows(self, at: np.ndarray) -> np.ndarray:
        """Rows of V⁻¹, left vectors, in the same shape."""
        return self.inverse[at].astype(float)
