"""Two eigenvalues that nearly meet, sharpened: are they real, or a pair?

After a pass of `carried` an eigenvector is right to the square of its coupling; its eigenvalue is
better, but not against the distance of one that it nearly meets. For such a plane, with R, L and
B = Lᵀ K R, one more step is taken: what the residuals show of the other modes l is added,

    R ← R + V_l (σ − λ_l)⁻¹ V_l⁻¹ (K R − R B),   L ← L + V_l⁻ᵀ (σ − λ_l)⁻¹ V_lᵀ (Kᵀ L − L Bᵀ)

on all other modes, σ = tr B / 2. The block of the new plane is then right to the fourth power.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from grainmodes.pairs.basis import Basis
from grainmodes.pairs.plane import Plane, planes_of

CLOSE = 1e-4
"""|λ1 − λ2|, k_N d^(1/2)/m, within which a pass does not tell a pair from two real modes."""

LOOSE = 0.15
"""The same for a strongly coupled mode, in units of its coupling squared; measured."""


def nearly_meeting(values: np.ndarray, coupling: np.ndarray) -> np.ndarray:
    """Places (K, 2) of two eigenvalues that nearly meet, for their coupling; none stands twice."""
    unsure = np.maximum(CLOSE, LOOSE * coupling**2)
    (pairs,) = np.nonzero((values.imag > 0.0) & (2.0 * values.imag < unsure))
    return np.array([*zip(pairs, pairs + 1, strict=True), *_couples(values, unsure)], int).reshape(
        -1, 2
    )


def _couples(values: np.ndarray, unsure: np.ndarray) -> list[tuple[int, int]]:
    """Neighbours among the real eigenvalues, the nearest ones first."""
    (real,) = np.nonzero(values.imag == 0.0)
    real = real[np.argsort(values.real[real], kind="stable")]
    gap = np.diff(values.real[real])
    close = gap < np.maximum(unsure[real[:-1]], unsure[real[1:]])
    found, used = [], set()
    for at in np.argsort(gap[close], kind="stable"):
        couple = tuple(real[np.flatnonzero(close)[at] :][:2].tolist())
        if used.isdisjoint(couple):
            found.append(couple)
            used.update(couple)
    return found


def sharpened(
    matrix: sparse.csr_array, basis: Basis, values: np.ndarray, couples: np.ndarray
) -> list[Plane]:
    """The planes of couples (K, 2) of modes, one step nearer to K's."""
    if not len(couples):
        return []
    right, left = (of(couples.ravel()) for of in (basis.columns, basis.rows))
    planes = planes_of(matrix, right, left)
    right, left = (np.hstack([getattr(p, side) for p in planes]) for side in ("right", "left"))
    block = scipy.linalg.block_diag(*(p.block for p in planes))
    middle = np.repeat([0.5 * p.sum for p in planes], 2)
    others = basis.coordinates(matrix @ right - right @ block)
    right += basis.vectors @ _divided(_without(others, couples), middle, values, basis.size)
    others = basis.products(matrix.T @ left - left @ block.T)
    left += basis.combined_rows(
        _divided(_without(others, couples), middle, values.conj(), 1.0 / basis.size)
    )
    return planes_of(matrix, right, left)


def _without(coordinates: np.ndarray, couples: np.ndarray) -> np.ndarray:
    """Coordinates (M, 2K) of fields of K planes, those within each plane left out."""
    coordinates[couples[:, :, None], np.arange(2 * len(couples)).reshape(-1, 1, 2)] = 0.0
    return coordinates


def _divided(
    coordinates: np.ndarray, middle: np.ndarray, values: np.ndarray, size: np.ndarray
) -> np.ndarray:
    """(σ − Λ)⁻¹ c for coordinates (M, K) in columns of norm 1, of the norms `size` in Λ.

    On Re u and Im u of a pair Λ is ((λ_r, λ_i), (−λ_i, λ_r)); on its left vectors λ_i is −λ_i.
    """
    distance = middle - values.real[:, None]
    found = coordinates * distance
    (pair,) = np.nonzero(values.imag)
    one, two = pair[::2], pair[1::2]
    turn = values.imag[one] * size[one] / size[two]
    back = values.imag[one] * size[two] / size[one]
    found[one] += turn[:, None] * coordinates[two]
    found[two] -= back[:, None] * coordinates[one]
    return found / (distance**2 + values.imag[:, None] ** 2)
