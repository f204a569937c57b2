"""Every complex pair of one large K, disc by disc, without a dense general solve.

Around a shift σ Arnoldi's method on (K − σ)⁻¹, one sparse factorisation, gives the eigenvalues
nearest to σ: all those in a disc. Discs on the real axis that overlap go up the whole spectrum,

    σ' = σ + (1 + STEP) ρ,   the gap halved where the next disc, radius ρ', does not reach back,

and each is taken between two cuts, in the widest gaps of the overlaps. Nothing is known of K
beforehand, and what is found is as exact as LAPACK's. That nothing is missing or counted twice is
seen from three numbers of K that are known without any solution:

    their number M,   Σλ = tr K,   Σλ² = tr K²

Few pairs stand so far from the real axis that no disc reaches them. Where the number says so they
are looked for around σ + iρ, σ + 2iρ, σ + 4iρ …, at every second, fourth … σ, until it is right.

The left vectors come from Kᵀ in the same way, only where a disc holds pairs. The translations,
known zero modes on both sides, are kept out of Arnoldi's vectors.

What it can miss is what LAPACK can: two eigenvalues that have just met, λ_i < `REAL`.

| symbol | name          | meaning                                  |
| ------ | ------------- | ---------------------------------------- |
| σ, ρ   | shift, radius | middle and radius of a disc without gaps |
| K      | matrix        | (M, M)                                   |
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigs, splu

from grainmodes.pairs.definition import Pairs, selected
from grainmodes.stability import REAL

NEAREST = 60
"""Eigenvalues of a disc: fewer need more factorisations, more need more restarts."""

FEW = 20
"""Eigenvalues of a disc around a complex shift, above the dense ones."""

WIDER = 2.4
"""Vectors of Arnoldi's method for every eigenvalue that is wanted."""

RESTARTS = 30
"""Of Arnoldi's method: few are usual, and a disc that needs more is not worth them."""

STEP = 0.8
"""Where the next disc stands, in radii above this one."""

RIGHT = 1e-9
"""What Σλ and Σλ² may be off by, in units of M max|K| and M max|K|²."""

SAME = 1e-6
"""Distance, in units of max|K|, within which λ of Kᵀ is that of K."""


class Disc(NamedTuple):
    """All eigenvalues (k,) within `radius` of a shift, with right vectors (M, k)."""

    shift: complex
    radius: float
    value: np.ndarray
    right: np.ndarray

    @property
    def low(self) -> float:
        """σ − ρ."""
        return self.shift.real - self.radius

    @property
    def high(self) -> float:
        """σ + ρ."""
        return self.shift.real + self.radius

    def between(self, low: float, high: float) -> np.ndarray:
        """Places of its eigenvalues with low <= λ_r < high."""
        return np.flatnonzero((self.value.real >= low) & (self.value.real < high))

    def among(self, at: np.ndarray) -> Disc:
        """The disc with some of its eigenvalues only."""
        return self._replace(value=self.value[at], right=self.right[:, at])


def pairs_by_windows(matrix: sparse.csr_array, null: np.ndarray) -> Pairs:
    """Every complex pair of K (M, M).

    Args:
        null: its zero modes on both sides (M, Z), orthonormal.

    Raises:
        ArithmeticError: an iteration did not converge, or the eigenvalues do not add up.
    """
    discs = _covering(lambda shift: _disc(matrix, null, shift), _scale(matrix), _top(matrix))
    cuts = [-np.inf, *(_cut(one, two) for one, two in pairwise(discs)), np.inf]
    parts = [
        disc.among(disc.between(*ends)) for disc, ends in zip(discs, pairwise(cuts), strict=True)
    ]
    parts += _above(matrix, null, discs, np.concatenate([part.value for part in parts]))
    _add_up(matrix, null, np.concatenate([part.value for part in parts]))
    found = [_with_left(matrix, null, part) for part in parts]
    value, right, left = (np.concatenate(of, axis=-1) for of in zip(*found, strict=True))
    return selected(value, right, left)


def _covering(disc_at: Callable[[float], Disc], scale: float, top: float) -> list[Disc]:
    """Discs that overlap one after the other, from below 0 to above every eigenvalue."""
    discs, ahead = [disc_at(-1e-4 * scale)], []
    while discs[-1].high < top:
        last = discs[-1]
        if ahead and ahead[-1].low < last.high:
            discs.append(ahead.pop())
        elif ahead:
            ahead.append(disc_at(0.5 * (last.high + ahead[-1].low)))
        else:
            ahead.append(disc_at(last.high + STEP * last.radius))
    return discs


def _above(
    matrix: sparse.csr_array, null: np.ndarray, discs: list[Disc], known: np.ndarray
) -> list[Disc]:
    """Pairs with their conjugates that stand above discs, until their number is right."""
    found, missing = [], matrix.shape[0] - null.shape[1] - len(known)
    for shift in _shifts_above(discs, 2.0 * _tallest(matrix)):
        if missing <= 0:
            break
        with suppress(ArithmeticError):  # what it would have found is missing in the number
            high = _disc(matrix, null, shift)
            apart = np.abs(high.value[:, None] - known).min(axis=1) > SAME * _scale(matrix)
            new = high.among(np.flatnonzero(apart & (high.value.imag > 0.0)))
            known = np.concatenate([known, new.value])
            both = np.concatenate([new.value, new.value.conj()])
            found.append(new._replace(value=both, right=np.hstack([new.right, new.right.conj()])))
            missing -= len(both)
    return found


def _shifts_above(discs: list[Disc], most: float) -> Iterator[complex]:
    """σ + iρ of every disc, σ + 2iρ of every second, … up to a height."""
    for stride in (2**layer for layer in range(len(discs).bit_length())):
        for disc in discs[::stride]:
            if stride * disc.radius <= most:
                yield complex(disc.shift, stride * disc.radius)


def _disc(matrix: sparse.csr_array, null: np.ndarray, shift: complex) -> Disc:
    """The eigenvalues nearest to a shift, but for the furthest one and its conjugate."""
    value, right = _nearest(matrix, null, shift)
    distance = np.abs(value - shift)
    inside = distance < (1.0 - 1e-9) * distance.max()
    return Disc(shift, float(distance.max()), value[inside], right[:, inside])


def _nearest(
    matrix: sparse.csr_array, null: np.ndarray, shift: complex
) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (k,) nearest to a shift and their right vectors (M, k), by Arnoldi's method."""
    size = matrix.shape[0]
    wanted = FEW if np.iscomplexobj(shift) else NEAREST
    count, width = (min(of, size // most) for of, most in ((wanted, 4), (WIDER * wanted, 2)))
    one = sparse.eye_array(size, format="csc")
    factors = splu((matrix - shift * one).tocsc(), permc_spec="MMD_AT_PLUS_A")

    def without_null(vector: np.ndarray) -> np.ndarray:
        return vector - null @ (null.T @ vector)

    start = without_null(np.random.default_rng(0).standard_normal(size).astype(type(shift)))
    inverse = LinearOperator(
        (size, size), lambda x: without_null(factors.solve(x)), dtype=start.dtype
    )
    try:
        value, vectors = eigs(inverse, count, v0=start, ncv=int(width), tol=1e-13, maxiter=RESTARTS)
    except RuntimeError as error:
        raise ArithmeticError(f"no eigenvalues near {shift:.6g}: {error}") from error
    return shift + 1.0 / value, vectors


def _cut(lower: Disc, upper: Disc) -> float:
    """The middle of the widest gap between eigenvalues in the overlap of two discs."""
    low, high = max(upper.low, lower.shift.real), min(lower.high, upper.shift.real)
    inner = np.concatenate([lower.value.real, upper.value.real])
    places = np.sort(np.concatenate([[low, high], inner[(inner > low) & (inner < high)]]))
    widest = int(np.argmax(np.diff(places)))
    return float(places[widest] + places[widest + 1]) / 2.0


def _with_left(
    matrix: sparse.csr_array, null: np.ndarray, disc: Disc
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The pairs (P,) among the eigenvalues of a disc, their right and left vectors (M, P)."""
    pairs = disc.among(np.flatnonzero(disc.value.imag > REAL))
    if not len(pairs.value):
        return pairs.value, pairs.right, pairs.right
    of_transposed, vectors = _nearest(matrix.T, null, np.conj(disc.shift))
    distance = np.abs(of_transposed.conj()[:, None] - pairs.value)
    if distance.min(axis=0).max() > SAME * _scale(matrix):
        raise ArithmeticError("the eigenvalues of the transposed matrix are others")
    return pairs.value, pairs.right, vectors[:, distance.argmin(axis=0)]


def _add_up(matrix: sparse.csr_array, null: np.ndarray, value: np.ndarray) -> None:
    """Refuse eigenvalues that are not all those of K."""
    size, scale = matrix.shape[0], _scale(matrix)
    if len(value) + null.shape[1] != size:
        raise ArithmeticError(f"{len(value) + null.shape[1]} of {size} eigenvalues were found")
    first, second = matrix.trace(), float((matrix * matrix.T).sum())
    off = max(abs(value.sum() - first) / scale, abs((value**2).sum() - second) / scale**2)
    if off > RIGHT * size:
        raise ArithmeticError(f"the eigenvalues do not add up to the trace: off by {off:.1e}")


def _scale(matrix: sparse.csr_array) -> float:
    """max|K|."""
    return float(np.abs(matrix.data).max())


def _top(matrix: sparse.csr_array) -> float:
    """Above every λ_r: the largest row sum of |K|."""
    return float(np.abs(matrix).sum(axis=1).max())


def _tallest(matrix: sparse.csr_array) -> float:
    """Above every λ_i: the largest row sum of |K − Kᵀ|/2, a bound of its norm."""
    return 0.5 * _top(matrix - matrix.T)
