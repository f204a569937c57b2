"""All complex pairs of one large K by a disc sweep, without a dense general eigensolver.

Overlapping discs on the real axis (`arnoldi_discs`) go up the whole spectrum,

    σ' = σ + (1 + SHIFT_SPACING) ρ,   the gap halved where the next disc, of radius ρ', leaves one,

and each keeps the eigenvalues between two cuts, in the widest gaps of the overlaps. Nothing has to
be known of K beforehand, and the eigenvalues are as exact as those of LAPACK. Three numbers of K
that are known without any solution certify that none is missing and none is counted twice:

    their number M,   Σλ = tr K,   Σλ² = tr K²

Above the overlaps, where the discs reach up less than half as far as in their middles, and above
the discs a few pairs are missing. Discs above the axis find them. They stand at the cuts, at
`HEIGHT_PER_SPACING` times their distance, then at every third cut three times as high, and so on,
which leaves no gap up to any height. The search ends as soon as the number is right.

What it can miss are pairs that have just met: those with λ_i below 1e-6 max|K|, the root of the
error of the factors, may be taken for two real eigenvalues, as LAPACK takes those below 1e-8.

| symbol | name          | meaning                                  |
| ------ | ------------- | ---------------------------------------- |
| σ, ρ   | shift, radius | middle and radius of a disc without gaps |
| K      | matrix        | (M, M)                                   |
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.arnoldi_discs import (
    RADIUS_PER_HEIGHT,
    SAME_EIGENVALUE,
    Disc,
    DiscSolver,
)
from grainmodes.complex_pairs.definition import ComplexPairs, select_pairs, with_rayleigh_quotients
from grainmodes.response.stability import REAL_TOLERANCE

SHIFT_SPACING = 0.8
"""Distance of the next shift from the upper end of a disc, in radii."""

HEIGHT_PER_SPACING = 0.83
"""Height of a disc above the axis, in distances between two discs of its row.

With a radius of 0.8 heights a row covers 0.4 to 1.3 of these distances, and the next row begins at
1.2."""

ROW_RATIO = 3
"""Height and spacing of a row, in those of the row below."""

SUM_TOLERANCE = 1e-9
"""Error of Σλ and Σλ², in units of M max|K| and M max|K|²."""


def pairs_by_disc_sweep(matrix: sparse.csr_array, null: np.ndarray) -> ComplexPairs:
    """All complex pairs of K (M, M).

    Args:
        null: its zero modes on both sides, (M, Z), orthonormal.

    Raises:
        ArithmeticError: an iteration did not converge, or the eigenvalues do not add up.
    """
    solver = DiscSolver(matrix, null)
    covering = _covering(solver.on_axis, solver.scale, _largest_real_part(matrix))
    cuts = [_cut(one, two) for one, two in pairwise(covering)]
    parts = [
        disc.subset((disc.value.real >= low) & (disc.value.real < high))
        for disc, (low, high) in zip(covering, pairwise([-np.inf, *cuts, np.inf]), strict=True)
    ]
    missing = matrix.shape[0] - null.shape[1] - sum(part.n_eigenvalues for part in parts)
    places = [covering[0].low, *cuts, covering[-1].high]
    shifts = _shifts_above(places, _largest_imaginary_part(matrix))
    del covering  # frees the vectors of overlapping discs
    parts += _discs_above(solver, shifts, np.concatenate([part.value for part in parts]), missing)
    _check_sums(matrix, null, parts)
    return _merge([_pairs_of_disc(matrix, solver, part) for part in parts])


def _pairs_of_disc(matrix: sparse.csr_array, solver: DiscSolver, part: Disc) -> ComplexPairs:
    """The pairs of a disc with both vectors and two-sided Rayleigh quotients."""
    pairs = part.value[part.value.imag > REAL_TOLERANCE]
    return with_rayleigh_quotients(
        matrix, select_pairs(pairs, part.right, solver.left_vectors(part))
    )


def _merge(parts: list[ComplexPairs]) -> ComplexPairs:
    """The pairs of all parts, λ_r ascending; the list is emptied to save memory."""
    value = np.concatenate([part.value for part in parts])
    place = np.argsort(np.argsort(value.real, kind="stable"), kind="stable")
    merged = ComplexPairs(
        np.empty_like(value), *np.empty((2, len(parts[0].right), len(value)), complex)
    )
    while parts:
        part = parts.pop()
        place, at = np.split(place, [len(place) - len(part.value)])
        for column, whole in zip(part, merged, strict=True):
            whole[..., at] = column
    return merged


def _covering(disc_at: Callable[[float], Disc], scale: float, top: float) -> list[Disc]:
    """Discs that overlap one after the other, from below 0 to above every eigenvalue."""
    discs = [disc_at(-1e-4 * scale)]
    ahead: list[Disc] = []
    while discs[-1].high < top:
        last = discs[-1]
        if ahead and ahead[-1].low < last.high:
            discs.append(ahead.pop())
        elif ahead:
            ahead.append(disc_at(0.5 * (last.high + ahead[-1].low)))
        else:
            ahead.append(disc_at(last.high + SHIFT_SPACING * last.radius))
    return discs


def _cut(lower: Disc, upper: Disc) -> float:
    """The middle of the widest gap between eigenvalues in the overlap of two discs."""
    low, high = max(upper.low, lower.shift.real), min(lower.high, upper.shift.real)
    inner = np.concatenate([lower.value.real, upper.value.real])
    places = np.sort(np.concatenate([[low, high], inner[(inner > low) & (inner < high)]]))
    widest = int(np.argmax(np.diff(places)))
    return float(places[widest] + places[widest + 1]) / 2.0


def _discs_above(
    solver: DiscSolver, shifts: Iterator[complex], known: np.ndarray, missing: int
) -> list[Disc]:
    """Discs with the pairs that are not `known` yet, until none is `missing`."""
    found = []
    while missing > 0 and (shift := next(shifts, None)) is not None:
        disc = solver.above_axis(shift)
        apart = np.abs(disc.value[:, None] - known).min(axis=1) > SAME_EIGENVALUE * solver.scale
        found.append(disc.subset(apart))
        known = np.concatenate([known, found[-1].value])
        missing -= found[-1].n_eigenvalues
    return found


def _shifts_above(places: list[float], highest: float) -> Iterator[complex]:
    """Rows of shifts above the inner ones of ascending places, up to λ_i = `highest`."""
    (low, *inner, high), stride = places, 1
    while stride <= len(inner):
        row = inner[stride // 2 :: stride]
        for before, place, after in zip([low, *row], row, [*row[1:], high], strict=False):
            height = HEIGHT_PER_SPACING * max(place - before, after - place)
            if (1.0 - RADIUS_PER_HEIGHT) * height < highest:
                yield complex(place, height)
        stride *= ROW_RATIO


def _check_sums(matrix: sparse.csr_array, null: np.ndarray, parts: list[Disc]) -> None:
    """Raise ArithmeticError unless number, Σλ and Σλ² are those of K."""
    size, number = matrix.shape[0], null.shape[1] + sum(part.n_eigenvalues for part in parts)
    if number != size:
        raise ArithmeticError(f"disc sweep: expected {size} eigenvalues, got {number}")
    value = np.concatenate([part.value for part in parts])
    scale, times = np.abs(matrix.data).max(), 1 + (value.imag > 0.0)
    first, second = matrix.trace(), float((matrix * matrix.T).sum())
    off = max(
        abs(times @ value.real - first) / scale, abs(times @ (value**2).real - second) / scale**2
    )
    if off > SUM_TOLERANCE * size:
        raise ArithmeticError(
            f"disc sweep: expected the eigenvalues to add up to the trace, got {off:.1e}"
        )


def _largest_real_part(matrix: sparse.csr_array) -> float:
    """A bound of λ_r: the largest row sum of |K|."""
    return float(np.abs(matrix).sum(axis=1).max())


def _largest_imaginary_part(matrix: sparse.csr_array) -> float:
    """A bound of λ_i: the largest row sum of |K − Kᵀ|/2."""
    return 0.5 * _largest_real_part(matrix - matrix.T)
