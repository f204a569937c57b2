"""All eigenpairs of a nearly diagonal matrix by second-order (Löwdin, Feshbach) partitioning.

    B = diag(d) + E,   d ascending,   E small, but not against the gaps of d

The spectrum is cut into windows of neighbouring modes. For one window let C be its modes, a margin
on both sides and the few *strongly coupled* modes, which are mixed with all others where a contact
has changed; R are the remaining modes. To second order in E the modes R act on C through

    S(λ) = B_CC + B_CR (λ − d_R)⁻¹ B_RC,   x_R = (λ − d_R)⁻¹ B_RC x_C

This effective matrix is linearised around the middle σ of the window,

    S(λ) ≃ S(σ) − (λ − σ) G,   G = B_CR (σ − d_R)⁻² B_RC,   (1 + G)⁻¹ (S(σ) − σ) x_C = (λ − σ) x_C

and the last equation is a dense eigenproblem of 72 modes, for which single precision is enough.
Neighbouring windows overlap in their margins, and a cut in the widest gap of the eigenvalues near
their border decides which window keeps an eigenvalue. The number of eigenvalues and the trace
defect |Σλ − tr B| certify that none is missing and none is counted twice.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.linalg import lapack

SIZE, MARGIN, MAX_STRONG = 72, 12, 16
"""Modes of C (LAPACK is slower from 75 on), in the margin on each side, and strongly coupled."""

STRONG_COUPLING = 20.0
"""|Σ_l E_kl E_lk| of a strongly coupled mode k, in units of the median of all modes."""

MAX_TRACE_DEFECT = 0.02
"""|Σλ − tr B| above which one eigenvalue was left out and another one counted twice."""


Arrays = tuple[np.ndarray, np.ndarray, np.ndarray]


class Eigensystem(NamedTuple):
    """All eigenpairs of B; a complex pair takes two places: λ and Re x, then λ* and Im x.

    Attributes:
        values: λ, (M,) complex128, of a pair first the one with λ_i > 0.
        rows: x, (M, M) float32, one row a vector.
        coupling: |x_R| / |x_C|, (M,) float32.
        trace_defect: |Σλ − tr B|.
    """

    values: np.ndarray
    rows: np.ndarray
    coupling: np.ndarray
    trace_defect: float


def partitioned_eigensystem(diagonal: np.ndarray, perturbation: np.ndarray) -> Eigensystem | None:
    """All eigenpairs of B; None where an eigenvalue is missing or counted twice.

    Args:
        diagonal: d, (M,) float64, ascending.
        perturbation: E, (M, M) float32 with 0 on the diagonal.
    """
    matrix = diagonal, perturbation, np.ascontiguousarray(perturbation.T)  # to read columns as rows
    size, strong = len(diagonal), strongly_coupled(*matrix[1:])
    width = SIZE - 2 * MARGIN - len(strong)
    edges = [*range(0, size - width // 2, width), size]
    with np.errstate(all="ignore"):  # a mode of R may stand exactly at σ or λ
        windows = [_solve_window(matrix, strong, *ends) for ends in pairwise(edges)]
        levels = [values.real for _, values, _ in windows]
        borders = [0.5 * diagonal[edge - 1 : edge + 1].sum() for edge in edges[1:-1]]
        cuts = [_cut(*two, at) for two, at in zip(pairwise(levels), borders, strict=True)]
        limits = pairwise([-np.inf, *cuts, np.inf])
        parts = [_extend(matrix, *each) for each in zip(windows, limits, strict=True)]
    values, rows, coupling = (np.concatenate(part) for part in zip(*parts, strict=True))
    trace_defect = abs(values.real.sum() - diagonal.sum())
    if len(values) != size or not np.isfinite(coupling).all() or trace_defect > MAX_TRACE_DEFECT:
        return None
    return Eigensystem(values, rows, coupling, trace_defect)


def strongly_coupled(perturbation: np.ndarray, transposed: np.ndarray) -> np.ndarray:
    """Places (K,) of the modes that couple most to all others, from E and Eᵀ (M, M); often none."""
    coupling = np.abs(np.einsum("kl,kl->k", perturbation, transposed))
    most = np.argsort(-coupling)[:MAX_STRONG]
    return most[np.flatnonzero(coupling[most] > STRONG_COUPLING * np.median(coupling))]


def _solve_window(matrix: Arrays, strong: np.ndarray, first: int, last: int) -> Arrays:
    """C (K,), λ (K,) and x_C (K, K) for the modes `first` to `last`, margins and strong ones."""
    diagonal, perturbation, transposed = matrix
    near = np.arange(max(first - MARGIN, 0), min(last + MARGIN, len(diagonal)))
    modes, middle = np.union1d(near, strong), diagonal[(first + last) // 2]
    distance = middle - diagonal
    block = perturbation[np.ix_(modes, modes)] - np.diag(distance[modes])
    distance[modes] = np.inf  # so that the sums over R leave out C
    inverse = (1.0 / distance).astype(np.float32)
    b_cr = perturbation[modes] * inverse
    second, slope = np.vsplit(np.vstack([b_cr, b_cr * inverse]) @ transposed[modes].T, 2)
    reduced = np.linalg.solve(np.eye(len(modes), dtype=np.float32) + slope, block + second)
    real, imaginary, _, vectors, _ = lapack.sgeev(reduced, compute_vl=0, overwrite_a=1)
    return modes, middle + real.astype(float) + 1j * imaginary, vectors.T


def _cut(lower: np.ndarray, upper: np.ndarray, border: float) -> float:
    """The middle of the widest gap that λ_r of two windows leave around their border."""
    values = np.sort(np.concatenate([lower, upper]))
    place = int(np.searchsorted(values, border))
    near = values[max(place - MARGIN, 0) : place + MARGIN]
    widest = int(np.argmax(np.diff(near)))
    return float(near[widest] + near[widest + 1]) / 2.0


def _extend(matrix: Arrays, window: Arrays, limits: tuple[float, float]) -> Arrays:
    """λ (n,) with λ_r inside the limits, their x (n, M) on all modes, and |x_R| / |x_C| (n,)."""
    (diagonal, _, transposed), (modes, values, inner) = matrix, window
    inside = (values.real >= limits[0]) & (values.real < limits[1])
    values, inner = values[inside], inner[inside]
    rows = inner @ transposed[modes]
    (pair,) = np.nonzero(values.imag > 0.0)
    complex_rows = (rows[pair] + 1j * rows[pair + 1]) / (values[pair, None] - diagonal)
    rows /= values.real[:, None] - diagonal
    rows[pair], rows[pair + 1] = complex_rows.real, complex_rows.imag
    rows[:, modes] = 0.0
    squares = np.stack([np.einsum("km,km->k", part, part) for part in (rows, inner)])
    squares[:, pair] = squares[:, pair + 1] = squares[:, pair] + squares[:, pair + 1]
    rows[:, modes] = inner
    return values, rows, np.sqrt(squares[0] / squares[1])
