"""Every complex pair of one large K, disc by disc, without a dense general solve.

Discs on the real axis that overlap (`discs`) go up the whole spectrum,

    σ' = σ + (1 + STEP) ρ,   the gap halved where the next disc, radius ρ', does not reach back,

and each is taken between two cuts, in the widest gaps of the overlaps. Nothing is known of K
beforehand, and what is found is as exact as LAPACK's. That nothing is missing or counted twice is
seen from three numbers of K that are known without any solution:

    their number M,   Σλ = tr K,   Σλ² = tr K²

Above the overlaps, where the discs reach up less than half as far as in their middles, and above
the discs a few pairs are missing. Discs above the axis look for them, at the cuts and at a height
of `TALL` times their distance, then at every third cut three times as high, and so on, which
leaves no gap up to any height; the search ends as soon as the number is right.

What it can miss are pairs that have just met: those with λ_i below 1e-6 max|K|, the root of what
the factors are off by, may be taken for two real eigenvalues, as LAPACK takes those below 1e-8.

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

from grainmodes.complex_pairs.arnoldi_discs import REACH, SAME, Disc, Discs
from grainmodes.complex_pairs.definition import ComplexPairs, select_pairs, with_rayleigh_quotients
from grainmodes.response.stability import REAL

STEP = 0.8
"""Where the next disc stands, in radii above this one."""

TALL = 0.83
"""Height of a disc above the axis in distances between two: with it and 0.8 of it as radius a row
reaches at the axis' discs from 0.4 to 1.3 of these distances, and the next row from 1.2 on."""

THRICE = 3
"""By how much each row is higher and wider than the one before."""

RIGHT = 1e-9
"""What Σλ and Σλ² may be off by, in units of M max|K| and M max|K|²."""


def pairs_by_windows(matrix: sparse.csr_array, null: np.ndarray) -> ComplexPairs:
    """Every complex pair of K (M, M).

    Args:
        null: its zero modes on both sides (M, Z), orthonormal.

    Raises:
        ArithmeticError: an iteration did not converge, or the eigenvalues do not add up.
    """
    discs = Discs(matrix, null)
    covering = _covering(discs.on_axis, discs.scale, _top(matrix))
    cuts = [_cut(one, two) for one, two in pairwise(covering)]
    parts = [
        disc.among((disc.value.real >= low) & (disc.value.real < high))
        for disc, (low, high) in zip(covering, pairwise([-np.inf, *cuts, np.inf]), strict=True)
    ]
    missing = matrix.shape[0] - null.shape[1] - sum(part.number for part in parts)
    shifts = _shifts_above([covering[0].low, *cuts, covering[-1].high], _tallest(matrix))
    del covering  # with the vectors of discs that overlap
    parts += _above(discs, shifts, np.concatenate([part.value for part in parts]), missing)
    _add_up(matrix, null, parts)
    return _merged([_pairs(matrix, discs, part) for part in parts])


def _pairs(matrix: sparse.csr_array, discs: Discs, part: Disc) -> ComplexPairs:
    """The pairs of a disc."""
    pairs = part.value[part.value.imag > REAL]
    return with_rayleigh_quotients(matrix, select_pairs(pairs, part.right, discs.left(part)))


def _merged(parts: list[ComplexPairs]) -> ComplexPairs:
    """The pairs of all parts, λ_r ascending; they are taken out of the list, one by one."""
    value = np.concatenate([part.value for part in parts])
    place = np.argsort(np.argsort(value.real, kind="stable"), kind="stable")
    merged = ComplexPairs(
        np.empty_like(value), *np.empty((2, len(parts[0].right), len(value)), complex)
    )
    while parts:
        part = parts.pop()
        place, at = np.split(place, [len(place) - len(part.value)])
        for of, whole in zip(part, merged, strict=True):
            whole[..., at] = of
    return merged


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


def _cut(lower: Disc, upper: Disc) -> float:
    """The middle of the widest gap between eigenvalues in the overlap of two discs."""
    low, high = max(upper.low, lower.shift.real), min(lower.high, upper.shift.real)
    inner = np.concatenate([lower.value.real, upper.value.real])
    places = np.sort(np.concatenate([[low, high], inner[(inner > low) & (inner < high)]]))
    widest = int(np.argmax(np.diff(places)))
    return float(places[widest] + places[widest + 1]) / 2.0


def _above(discs: Discs, shifts: Iterator[complex], known: np.ndarray, missing: int) -> list[Disc]:
    """Discs of pairs that are not known, until their number is right."""
    found = []
    while missing > 0 and (shift := next(shifts, None)) is not None:
        disc = discs.above_axis(shift)
        apart = np.abs(disc.value[:, None] - known).min(axis=1) > SAME * discs.scale
        found.append(disc.among(apart))
        known = np.concatenate([known, found[-1].value])
        missing -= found[-1].number
    return found


def _shifts_above(places: list[float], most: float) -> Iterator[complex]:
    """Rows of shifts above the inner ones of ascending places, as far as λ_i = `most`."""
    (low, *inner, high), stride = places, 1
    while stride <= len(inner):
        row = inner[stride // 2 :: stride]
        for before, place, after in zip([low, *row], row, [*row[1:], high], strict=False):
            height = TALL * max(place - before, after - place)
            if (1.0 - REACH) * height < most:
                yield complex(place, height)
        stride *= THRICE


def _add_up(matrix: sparse.csr_array, null: np.ndarray, parts: list[Disc]) -> None:
    """Refuse eigenvalues that are not all those of K."""
    size, number = matrix.shape[0], null.shape[1] + sum(part.number for part in parts)
    if number != size:
        raise ArithmeticError(f"{number} of {size} eigenvalues were found")
    value = np.concatenate([part.value for part in parts])
    scale, times = np.abs(matrix.data).max(), 1 + (value.imag > 0.0)
    first, second = matrix.trace(), float((matrix * matrix.T).sum())
    off = max(
        abs(times @ value.real - first) / scale, abs(times @ (value**2).real - second) / scale**2
    )
    if off > RIGHT * size:
        raise ArithmeticError(f"the eigenvalues do not add up to the trace: off by {off:.1e}")


def _top(matrix: sparse.csr_array) -> float:
    """Above every λ_r: the largest row sum of |K|."""
    return float(np.abs(matrix).sum(axis=1).max())


def _tallest(matrix: sparse.csr_array) -> float:
    """Above every λ_i: the largest row sum of |K − Kᵀ|/2, a bound of its norm."""
    return 0.5 * _top(matrix - matrix.T)
