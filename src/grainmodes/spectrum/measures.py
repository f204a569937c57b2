"""What is measured on an eigenvector: A (49), (50), (E1).

    ψ^R_n = Σ_i |R^ℓ_n,i|²,   ψ^T_n = 1 − ψ^R_n
    p_n = (Σ_i |R_n,i|²)² / (N Σ_i |R_n,i|⁴)

and R_n · f with given forces f, from which sums over modes are made (`modes`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse


class Measured(NamedTuple):
    """Of M modes: λ (M,), ψ^R (M,), p (M,), ‖J R − λ R‖ (M,), R · f of F forces (M, F)."""

    eigenvalue: np.ndarray
    psi_rotational: np.ndarray
    participation_ratio: np.ndarray
    residual: np.ndarray
    projection: np.ndarray

    @classmethod
    def of(cls, matrix: sparse.csc_array, k: int, forces, values, vectors) -> Measured:
        """Measure eigenpairs of J with k degrees of freedom a grain; `forces` is (M, F)."""
        weight = np.abs(vectors.reshape(len(vectors) // k, k, len(values))) ** 2
        return cls(
            values,
            rotational_fraction(weight),
            participation_ratio(weight),
            np.linalg.norm(matrix @ vectors - vectors * values, axis=0),
            vectors.T @ forces,
        )

    @classmethod
    def joined(cls, parts: list[Measured]) -> Measured:
        """Modes of several windows below each other."""
        return cls(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def turned(self) -> Measured:
        """The modes of −J, which are those of J from the highest to the lowest."""
        modes = Measured(*(column[::-1] for column in self))
        return modes._replace(eigenvalue=-modes.eigenvalue)


def rotational_fraction(weight: np.ndarray) -> np.ndarray:
    """ψ^R of every mode from |R|² of shape (N, k, M): A (50); 0 where rotation does not exist."""
    return weight[:, 2].sum(axis=0) if weight.shape[1] == 3 else np.zeros(weight.shape[2])


def participation_ratio(weight: np.ndarray) -> np.ndarray:
    """p of every mode from |R|² of shape (N, k, M): A (E1)."""
    grain = weight.sum(axis=1)
    return grain.sum(axis=0) ** 2 / (len(grain) * (grain**2).sum(axis=0))
