"""What is measured on a mode: its rotational fraction and participation ratio; A (49), (50), (E1).

    ψ^R_n = Σ_i |R^ℓ_n,i|²,   ψ^T_n = 1 − ψ^R_n
    p_n = (Σ_i |R_n,i|²)² / (N Σ_i |R_n,i|⁴)

the grain that moves most, and its projection R_n · f on given forces f, from which sums over modes
are made (`response.mode_sum`).

| symbol          | name                | shape  | unit        |
| --------------- | ------------------- | ------ | ----------- |
| λ_n             | eigenvalue          | (M,)   | k_N d^(1/2) |
| ψ^R_n           | psi_rotational      | (M,)   | 1           |
| p_n             | participation_ratio | (M,)   | 1           |
| argmax_i ‖R_n,i‖ | peak_grain         | (M,)   | 1           |
| ‖J R_n − λ R_n‖ | residual            | (M,)   | k_N d^(1/2) |
| R_n · f         | projection          | (M, F) | that of f   |
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

from grainmodes.spectrum.eigenproblem import Numbers


class ModeMeasures(NamedTuple):
    """Measures of M modes: arrays as in the table of this module."""

    eigenvalue: Numbers
    psi_rotational: NDArray[np.float64]
    participation_ratio: NDArray[np.float64]
    peak_grain: NDArray[np.float64]
    residual: NDArray[np.float64]
    projection: Numbers

    @classmethod
    def from_eigenpairs(
        cls,
        matrix: sparse.csc_array,
        k: int,
        forces: NDArray[np.float64],
        values: Numbers,
        vectors: Numbers,
    ) -> ModeMeasures:
        """Measure modes of J.

        Args:
            matrix: J, (kN, kN).
            k: rows of J per grain, 2 or 3.
            forces: (kN, F) to project the modes on.
            values: λ (M,).
            vectors: R (kN, M), one normalised column per mode.
        """
        weight = np.abs(vectors.reshape(len(vectors) // k, k, len(values))) ** 2
        return cls(
            values,
            rotational_fraction(weight),
            participation_ratio(weight),
            peak_grain(weight),
            np.linalg.norm(matrix @ vectors - vectors * values, axis=0),
            vectors.T @ forces,
        )

    @classmethod
    def concatenated(cls, parts: list[ModeMeasures]) -> ModeMeasures:
        """The modes of all parts, one part after the other."""
        columns: list[NDArray] = [np.concatenate(column) for column in zip(*parts, strict=True)]
        return cls(*columns)

    def negated(self) -> ModeMeasures:
        """The same modes as those of −J, in the opposite order: ascending stays ascending."""
        columns: list[NDArray] = [column[::-1] for column in self]
        modes = ModeMeasures(*columns)
        return modes._replace(eigenvalue=-modes.eigenvalue)


def rotational_fraction(weight: NDArray[np.float64]) -> NDArray[np.float64]:
    """ψ^R (M,) from |R|² of shape (N, k, M): A (50); zero where grains do not rotate (k = 2)."""
    return weight[:, 2].sum(axis=0) if weight.shape[1] == 3 else np.zeros(weight.shape[2])


def peak_grain(weight: NDArray[np.float64]) -> NDArray[np.float64]:
    """The number of the grain that moves most (M,), from |R|² of shape (N, k, M)."""
    grain = weight.sum(axis=1)
    return grain.argmax(axis=0).astype(float) if grain.size else np.zeros(grain.shape[1])


def participation_ratio(weight: NDArray[np.float64]) -> NDArray[np.float64]:
    """p (M,) from |R|² of shape (N, k, M): A (E1)."""
    grain = weight.sum(axis=1)
    return grain.sum(axis=0) ** 2 / (len(grain) * (grain**2).sum(axis=0))
