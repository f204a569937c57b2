"""All eigenvalues of a nearly diagonal matrix that is not symmetric, window by window.

    B = diag(d) + E,   d ascending,   E small but not against the gaps of d

The eigenvalues near a place in the spectrum come from the modes C around it, a window and some
margin; the others R act on them through what is second order in E,

    S(λ) = B_CC + B_CR (λ − d_R)⁻¹ B_RC,   x_R = (λ − d_R)⁻¹ B_RC x_C

linear in λ around the middle σ of the window, S ≃ S(σ) − (λ − σ) G, G = B_CR (σ − d_R)⁻² B_RC, so
that λ − σ are the eigenvalues of (1 + G)⁻¹ (S(σ) − σ), which is solved densely. All of it is small,
and single precision is enough. A few modes that couple to all others, the hubs, stand in every
window: where a contact has changed, all modes that live there are mixed.

Each window gives the eigenvalues between two cuts in the widest gaps near its ends. That none is
missing or counted twice is seen from their number and their sum, tr B.

| symbol        | name             | shape                                          |
| ------------- | ---------------- | ---------------------------------------------- |
| d, E, Eᵀ      | diagonal, change, transposed | (M,), (M, M)                       |
| C             | inside           | places (K,) of the modes of a window           |
| B_CR, B_RCᵀ   | reach, back      | (K, M), with the columns of C as well          |
| x_C           | inner            | (n, K), of a pair its real and imaginary part  |
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.linalg import lapack

SIZE, MARGIN, HUBS = 72, 12, 16
"""Modes solved with a window, of these in the margin on each side, and most of them hubs.

LAPACK takes another, slower path from 75 on.
"""

MISCOUNTED = 0.02
"""Missing part of tr B from which an eigenvalue was left out and another one taken twice."""

OUTSTANDING = 20.0
"""Coupling of such a mode to all others, in units of the median."""


class Solved(NamedTuple):
    """Eigenvalues (M,) of B; of a complex pair the one with λ_i > 0 stands before its conjugate.

    `rows`, (M, M) float32: eigenvectors, of a pair its real and its imaginary part. `coupling`,
    (M,): the part of an eigenvector outside its window, in units of that within. `missing`: by how
    much the sum of the eigenvalues is not tr B.
    """

    values: np.ndarray
    rows: np.ndarray
    coupling: np.ndarray
    missing: float


class NearlyDiagonal(NamedTuple):
    """B = diag(d) + E: d (M,) ascending, E and Eᵀ (M, M) float32 with 0 on the diagonal.

    `order`, (M,): where each mode stood before.
    """

    order: np.ndarray
    diagonal: np.ndarray
    change: np.ndarray
    transposed: np.ndarray

    @classmethod
    def of(cls, diagonal: np.ndarray, change: np.ndarray) -> NearlyDiagonal:
        """From d in any order, and E (M, M) with a diagonal."""
        diagonal = diagonal + np.diagonal(change)
        order = np.argsort(diagonal, kind="stable")
        transposed = np.ascontiguousarray(change[order].T)[order]
        np.fill_diagonal(transposed, 0.0)
        return cls(order, diagonal[order], np.ascontiguousarray(transposed.T), transposed)

    def partly(self, part: float) -> NearlyDiagonal:
        """A part of the way from diag(d) to B."""
        return self._replace(change=part * self.change, transposed=part * self.transposed)

    @property
    def hubs(self) -> np.ndarray:
        """The modes that couple most to all others, if they stand out."""
        coupling = np.abs(np.einsum("kl,kl->k", self.change, self.transposed))
        most = np.argsort(-coupling)[:HUBS]
        return most[coupling[most] > OUTSTANDING * np.median(coupling)]


class Window(NamedTuple):
    """Eigenvalues (K,) of the modes around a place in the spectrum, their vectors as rows."""

    inside: np.ndarray
    values: np.ndarray
    inner: np.ndarray

    def between(self, low: float, high: float) -> Window:
        """Those with low <= λ_r < high."""
        these = (self.values.real >= low) & (self.values.real < high)
        return Window(self.inside, self.values[these], self.inner[these])


def solved(matrix: NearlyDiagonal) -> Solved | None:
    """The eigenpairs of B; None where an eigenvalue is missing or counted twice."""
    size, hubs = len(matrix.diagonal), matrix.hubs
    width = SIZE - 2 * MARGIN - len(hubs)
    edges = [*range(0, size - width // 2, width), size]
    with np.errstate(all="ignore"):  # a mode outside a window may stand exactly at its λ
        windows = [*_windows(matrix, edges, hubs)]
        ends = [0.5 * matrix.diagonal[end - 1 : end + 1].sum() for end in edges[1:-1]]
        cuts = [_cut(*both, end) for both, end in zip(pairwise(windows), ends, strict=True)]
        limits = pairwise([-np.inf, *cuts, np.inf])
        taken = [of.between(*ends) for of, ends in zip(windows, limits, strict=True)]
        values = np.concatenate([of.values for of in taken])
        if len(values) != size:
            return None
        rows, coupling = (
            np.concatenate(of) for of in zip(*(_extended(matrix, of) for of in taken), strict=True)
        )
    missing = abs(values.real.sum() - matrix.diagonal.sum())
    if not np.isfinite(coupling).all() or missing > MISCOUNTED:
        return None
    return Solved(values, rows, coupling, missing)


def _windows(matrix: NearlyDiagonal, edges: list[int], hubs: np.ndarray) -> Iterator[Window]:
    """All modes between two edges and in the margins on both sides, by LAPACK."""
    for first, last in pairwise(edges):
        near = np.arange(max(first - MARGIN, 0), min(last + MARGIN, edges[-1]))
        inside, middle = np.union1d(near, hubs), matrix.diagonal[(first + last) // 2]
        reduced = _reduced(matrix, inside, middle)
        real, imaginary, _, vectors, _ = lapack.sgeev(reduced, compute_vl=0, overwrite_a=1)
        yield Window(inside, middle + real.astype(float) + 1j * imaginary, vectors.T)


def _reduced(matrix: NearlyDiagonal, inside: np.ndarray, middle: float) -> np.ndarray:
    """(1 + G)⁻¹ (S(σ) − σ) of the modes `inside`."""
    distance = middle - matrix.diagonal
    block = matrix.change[np.ix_(inside, inside)] - np.diag(distance[inside])
    distance[inside] = np.inf
    inverse = (1.0 / distance).astype(np.float32)
    reach = matrix.change[inside] * inverse
    both = np.vstack([reach, reach * inverse]) @ matrix.transposed[inside].T
    second, bend = both[: len(inside)], both[len(inside) :]
    return np.linalg.solve(np.eye(len(inside), dtype=np.float32) + bend, block + second)


def _cut(left: Window, right: Window, wanted: float) -> float:
    """The middle of the widest gap that two windows leave around a place."""
    values = np.sort(np.concatenate([left.values.real, right.values.real]))
    place = int(np.searchsorted(values, wanted))
    near = values[max(place - MARGIN, 0) : place + MARGIN]
    widest = int(np.argmax(np.diff(near)))
    return float(near[widest] + near[widest + 1]) / 2.0


def _extended(matrix: NearlyDiagonal, window: Window) -> tuple[np.ndarray, np.ndarray]:
    """The vectors (K, M) of a window over all modes, and the parts outside it."""
    inside, values, inner = window
    vectors = _divided(inner @ matrix.transposed[inside], values, matrix.diagonal)
    vectors[:, inside] = 0.0
    parts = np.stack([np.einsum("km,km->k", of, of) for of in (vectors, inner)])
    vectors[:, inside] = inner
    (pair,) = np.nonzero(values.imag > 0.0)
    parts[:, pair] = parts[:, pair + 1] = parts[:, pair] + parts[:, pair + 1]
    return vectors, np.sqrt(parts[0] / parts[1])


def _divided(rows: np.ndarray, values: np.ndarray, diagonal: np.ndarray) -> np.ndarray:
    """(λ − d)⁻¹ x for rows x (K, M) of eigenvalues λ, of a pair its real and imaginary part."""
    distance = (values.real[:, None] - diagonal).astype(np.float32)
    imaginary = values.imag.astype(np.float32)[:, None]
    found = rows * distance
    (pair,) = np.nonzero(values.imag > 0.0)
    found[pair] += rows[pair + 1] * imaginary[pair]
    found[pair + 1] -= rows[pair] * imaginary[pair]
    distance *= distance
    distance += imaginary**2
    found /= distance
    return found
