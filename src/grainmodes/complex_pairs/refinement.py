"""Refinement of invariant subspaces: which eigenvalues are complex pairs, and where are they?

After a partitioning the error of an eigenvector is of the order of its coupling squared. That is
enough for an eigenvalue by itself, but not for two that nearly meet. Every complex pair, and every
two near-degenerate neighbours, therefore span a subspace with a residual in double precision
(`invariant_subspaces`). In the eigenbasis V, where K is nearly Λ, a Newton step refines it:

    R ← R + V X,      X B − Λ X = V⁻¹ (K R − R B)
    L ← L + V⁻ᵀ Y,    Y Bᵀ − Λᵀ Y = Vᵀ (Kᵀ L − L Bᵀ)

These are Sylvester equations with a diagonal Λ: mode k has x_k = c_k (B − λ_k)⁻¹ with the whole
2 × 2 block, so that λ_k may lie between the two eigenvalues of B. A step squares a residual, unless
a third mode is near-degenerate with the two.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from scipy.linalg import lapack

from grainmodes.complex_pairs.invariant_subspaces import Subspaces
from grainmodes.complex_pairs.partitioning import Eigensystem
from grainmodes.response.stability import REAL_TOLERANCE

RESIDUAL_TOLERANCE, MAX_STEPS = 1e-4, 3
"""Residual of a converged subspace, in units of max|K|, and Newton steps to reach it."""

MAX_NEAR_DEGENERATE, MAX_UNCONVERGED = 0.25, 0.125
"""Near-degenerate neighbours per mode, and share of unconverged subspaces after a step, above which
another partitioning costs less."""

MIN_GAP, GAP_PER_COUPLING = 1e-4, 0.3
"""|λ1 − λ2| of near-degenerate eigenvalues, k_N d^(1/2)/m, and per coupling squared; measured."""


class Eigenbasis(NamedTuple):
    """Approximate eigenvectors of K as a real basis, with its inverse.

    Attributes:
        vectors: V, (M, M) float32, columns of norm 1: u, or of a pair Re u and then Im u.
        norms: (M,), norms of the columns before; Im u may be tiny against Re u.
        inverse: V⁻¹, (M, M) float32; its rows are the left eigenvectors.
    """

    vectors: np.ndarray
    norms: np.ndarray
    inverse: np.ndarray

    @classmethod
    def from_vectors(cls, vectors: np.ndarray) -> Eigenbasis:
        """The basis of real columns (M, M) of any norm."""
        norms = np.linalg.norm(vectors, axis=0)
        columns = (vectors / norms).astype(np.float32)
        factors, pivots, _ = lapack.sgetrf(columns.T)
        inverse, _ = lapack.sgetri(factors, pivots, lwork=256 * len(norms))  # 256 columns at once
        return cls(columns, norms, inverse.T)


def near_degenerate(values: np.ndarray, coupling: np.ndarray) -> np.ndarray:
    """Places (P, 2) of low pairs and close real neighbours, nearest first, no eigenvalue twice."""
    limit = np.maximum(MIN_GAP, GAP_PER_COUPLING * coupling**2)
    (pairs,) = np.nonzero((values.imag > 0.0) & (2.0 * values.imag < limit))
    (real,) = np.nonzero(values.imag == 0.0)
    real = real[np.argsort(values.real[real], kind="stable")]
    gap = np.diff(values.real[real])
    (close,) = np.nonzero(gap < np.maximum(limit[real[:-1]], limit[real[1:]]))
    neighbours, free = np.stack([real[:-1], real[1:]], axis=1), np.ones(len(values), bool)
    places = [*np.stack([pairs, pairs + 1], axis=1)]
    for two in neighbours[close[np.argsort(gap[close], kind="stable")]]:
        if free[two].all():
            places.append(two)
            free[two] = False
    return np.array(places, int).reshape(-1, 2)


def refined_subspaces(
    matrix: sparse.csr_array, basis: Eigenbasis, found: Eigensystem
) -> Subspaces | None:
    """The subspaces of all complex pairs and near-degenerate neighbours of K (M, M).

    None where too many are near-degenerate or some do not converge.
    """
    unsure = near_degenerate(found.values, found.coupling)
    if len(unsure) > MAX_NEAR_DEGENERATE * len(found.values):
        return None
    isolated = np.setdiff1d(np.flatnonzero(found.values.imag > REAL_TOLERANCE), unsure)
    modes = np.vstack([unsure, np.stack([isolated, isolated + 1], axis=1)])
    right, left = (rows[modes].astype(float) for rows in (basis.vectors.T, basis.inverse))
    subspaces = Subspaces.spanned_by(matrix, right, left)
    unconverged = subspaces.residual >= RESIDUAL_TOLERANCE
    unconverged[: len(unsure)] = True
    for _ in range(MAX_STEPS):
        if not unconverged.any():
            break
        chosen = slice(None) if unconverged.all() else unconverged  # without a copy of all
        start = Subspaces(*(part[chosen] for part in subspaces))
        vectors = _newton_step(start, basis, found.values, modes[chosen])
        for part, better in zip(subspaces, Subspaces.spanned_by(matrix, *vectors), strict=True):
            part[chosen] = better
        unconverged = ~(subspaces.residual < RESIDUAL_TOLERANCE)
        if unconverged.sum() > MAX_UNCONVERGED * len(unconverged):
            return None
    return None if unconverged.any() else subspaces


def _newton_step(
    start: Subspaces, basis: Eigenbasis, values: np.ndarray, modes: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """R + V X and L + V⁻ᵀ Y, (P, 2, M), without the `modes` (P, 2) that span the subspace."""
    vectors, norms, inverse = basis
    each, block = np.arange(len(modes))[:, None], start.block

    def product(rows: np.ndarray, matrix: np.ndarray) -> np.ndarray:
        flat = rows.reshape(-1, len(values)).astype(np.float32, copy=False) @ matrix
        return np.asarray(flat).reshape(rows.shape)

    right, left = product(start.right_residual, inverse.T), product(start.left_residual, vectors)
    right[each, :, modes] = left[each, :, modes] = 0.0
    right = _sylvester(right, block, values, norms)
    left = _sylvester(left, block.swapaxes(1, 2), values.conj(), 1.0 / norms)
    return start.right + product(right, vectors.T), start.left + product(left, inverse)


@np.errstate(divide="ignore", invalid="ignore", over="ignore")  # the subspace stays unconverged
def _sylvester(
    c: np.ndarray, block: np.ndarray, values: np.ndarray, norms: np.ndarray
) -> np.ndarray:
    """The x (P, 2, M) of x B − Λ x = c. On α Re u + β Im u of a pair Λ multiplies α − iβ by λ."""
    (pair,) = np.nonzero(values.imag)
    one, two = pair[::2], pair[1::2]
    ratio = (norms[one] / norms[two]).astype(np.float32)
    z = c.astype(np.complex64)
    z[:, :, one] -= 1j * ratio * c[:, :, two]
    (p, q), (r, s) = np.moveaxis(block, 0, -1)[..., None]
    p, s = ((entry - values).astype(np.complex64) for entry in (p, s))
    q, r = (entry.astype(np.float32) for entry in (q, r))
    scale = 1.0 / (p * s - q * r)
    x = np.stack([z[:, 0] * s - z[:, 1] * r, z[:, 1] * p - z[:, 0] * q], axis=1) * scale[:, None]
    x.real[:, :, two] = -x.imag[:, :, one] / ratio
    return np.real(x)
