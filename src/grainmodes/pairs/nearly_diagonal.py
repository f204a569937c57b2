"""All eigenvalues of a nearly diagonal matrix that is not symmetric, window by window.

    B = diag(d) + E,   d ascending,   E small but not against the gaps of d

The eigenvalues near a place in the spectrum come from the modes C around it, a window and some
margin; the others R act on them through what is second order in E,

    S(λ) = B_CC + B_CR (λ − d_R)⁻¹ B_RC,   x_R = (λ − d_R)⁻¹ B_RC x_C

linear in λ around the middle σ of the window, S ≃ S(σ) − (λ − σ) G, G = B_CR (σ − d_R)⁻² B_RC, so
that (1 + G)⁻¹ (S(σ) + σ G) is solved densely. A few modes that couple to all others, the hubs,
stand in every window: where a contact has changed, all modes that live there are mixed. Broad
windows cost three times as much as narrow ones and stand larger changes.

Each window gives the eigenvalues between two cuts in the widest gaps near its ends. That none is
missing or counted twice is seen from their number and their sum, tr B.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np


class Window(NamedTuple):
    """Modes of a window, those solved with it on both sides, and most modes in every window."""

    width: int
    margin: int
    hubs: int


NARROW, BROAD = Window(24, 12, 8), Window(48, 24, 24)

OUTSTANDING = 20.0
"""Coupling of such a mode to all others, in units of the median."""

SUM_RIGHT = 1e-3
"""What the sum of the eigenvalues may be off by."""


class Solved(NamedTuple):
    """Eigenvalues (M,) of B; of a complex pair the one with λ_i > 0 stands before its conjugate.

    `rows`, (M, M) float32: eigenvectors, of a pair its real and its imaginary part. `coupling`,
    (M,): the part of an eigenvector outside its window, in units of that within.
    """

    values: np.ndarray
    rows: np.ndarray
    coupling: np.ndarray


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
        transposed = change.T[np.ix_(order, order)].astype(np.float32, copy=False)
        np.fill_diagonal(transposed, 0.0)
        return cls(order, diagonal[order], np.ascontiguousarray(transposed.T), transposed)

    def hubs(self, most: int) -> np.ndarray:
        """The modes that couple most to all others, if they stand out."""
        coupling = np.abs(np.einsum("kl,kl->k", self.change, self.transposed))
        most = np.argsort(-coupling)[:most]
        return most[coupling[most] > OUTSTANDING * np.median(coupling)]


def solved(matrix: NearlyDiagonal, window: Window = NARROW) -> Solved | None:
    """The eigenpairs of B; None where they do not add up."""
    try:
        return _gathered(matrix, window)
    except np.linalg.LinAlgError:  # a mode outside a window stands exactly in its middle
        return None


def _gathered(matrix: NearlyDiagonal, window: Window) -> Solved | None:
    size = len(matrix.diagonal)
    values, rows = np.zeros(size, complex), np.zeros((size, size), np.float32)
    place, coupling = 0, np.zeros(size)
    for found, vectors, outside in _windows(matrix, window):
        pair = found.imag > 0.0
        at = place + np.arange(len(found)) + np.cumsum(pair) - pair
        place += len(found) + int(pair.sum())
        if place > size:
            return None
        values[at], values[at[pair] + 1] = found, found[pair].conj()
        rows[at], rows[at[pair] + 1] = vectors.real, vectors.imag[pair]
        coupling[at], coupling[at[pair] + 1] = outside, outside[pair]
    missing = abs(values.real.sum() - matrix.diagonal.sum())
    return Solved(values, rows, coupling) if place == size and missing < SUM_RIGHT else None


def _windows(
    matrix: NearlyDiagonal, window: Window
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Window by window: its eigenvalues with λ_i >= 0, their vectors, their coupling."""
    diagonal, hubs, low = matrix.diagonal, matrix.hubs(window.hubs), -np.inf
    size, width, margin = len(diagonal), window.width, window.margin
    edges = [*range(0, size - width // 2, width), size]
    for first, last in pairwise(edges):
        near = np.arange(max(first - margin, 0), min(last + margin, size))
        inside = np.union1d(near, hubs)
        values, inner = np.linalg.eig(_reduced(matrix, inside, diagonal[(first + last) // 2]))
        high = np.inf
        if last < size:
            end = 0.5 * (diagonal[last - 1] + diagonal[last])
            high = _cut(np.sort(values.real), end, margin // 2)
        taken = (values.real >= low) & (values.real < high) & (values.imag >= 0.0)
        yield _extended(matrix, inside, values[taken], inner[:, taken].T)
        low = high


def _reduced(matrix: NearlyDiagonal, inside: np.ndarray, middle: float) -> np.ndarray:
    """(1 + G)⁻¹ (S(σ) + σ G) of the modes `inside`."""
    inverse = _inverse(middle, matrix.diagonal, inside)
    back = matrix.transposed[inside].T
    reach = matrix.change[inside] * inverse
    with np.errstate(invalid="ignore"):
        second, bend = reach @ back, (reach * inverse) @ back
    block = np.diag(matrix.diagonal[inside]) + matrix.change[np.ix_(inside, inside)] + second
    return np.linalg.solve(np.eye(len(inside)) + bend, block + middle * bend)


def _inverse(value, diagonal: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """1/(λ − d) in single precision, 0 for the modes `inside`."""
    distance = value - diagonal
    distance[..., inside] = np.inf
    single = np.complex64 if np.iscomplexobj(distance) else np.float32
    with np.errstate(divide="ignore", over="ignore"):
        return (1.0 / distance).astype(single)


def _cut(values: np.ndarray, wanted: float, around: int) -> float:
    """The middle of the widest gap among the eigenvalues around a place."""
    place = int(np.searchsorted(values, wanted))
    near = values[max(place - around, 0) : place + around]
    widest = int(np.argmax(np.diff(near)))
    return float(near[widest] + near[widest + 1]) / 2.0


def _extended(
    matrix: NearlyDiagonal, inside: np.ndarray, values: np.ndarray, inner: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eigenvalues, their vectors (K, M) over all modes, and the parts outside the window."""
    vectors = inner.astype(np.complex64) @ matrix.transposed[inside]
    vectors *= _inverse(values[:, None], matrix.diagonal, inside)
    outside = np.linalg.norm(vectors, axis=1) / np.linalg.norm(inner, axis=1)
    vectors[:, inside] = inner
    return values, vectors, outside
