"""Spectrum slicing: the spectrum of a symmetric J in slices of about 150 eigenvalues each.

Inertia counts (`linalg.symmetric_shift`) split an interval of λ into slices [low, high) of known
numbers of eigenvalues. The eigenpairs of a slice (`slice_eigenpairs`) are then certified complete:
their number must be the difference of the counts at its two ends. A slice is easy to solve if its
eigenvalues do not lie beside a much denser group, and if its ends differ by less than a decade.

| symbol     | name            | meaning                                                      |
| ---------- | --------------- | ------------------------------------------------------------ |
| σ, n(σ)    | CountedShift    | a shift in k_N d^(1/2), and the number of eigenvalues below  |
| [low, high) | SpectralSlice  | an interval of λ in k_N d^(1/2), and its number of modes     |
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from grainmodes.linalg.symmetric_shift import SymmetricShift

SLICE_MODES = 150
"""Largest number of modes in a slice, where the basis of its Krylov space fits into the cache."""

LARGE_MATRIX_SLICE_MODES = 60
"""The same for a matrix of `LARGE_MATRIX_SIZE` rows or more."""

LARGE_MATRIX_SIZE = 30_000
"""Number of rows from which slices are the smaller ones."""

COUNT_TOLERANCE = 0.1
"""Largest difference between the count at the end of a slice and its target, in slices."""

MAX_NEIGHBOUR_RATIO = 4
"""Largest number of eigenvalues within twice the half-width of a slice, per eigenvalue in it.

Up to this ratio block Lanczos separates the eigenvalues of the slice from those beside it. An even
density has the ratio 2."""

NEIGHBOUR_ALLOWANCE = 64
"""Number of eigenvalues that may lie there in addition, however few the slice holds: they fit into
four blocks of Lanczos vectors."""

OUTER_END_RATIO = 1.05
"""Largest ratio between an outermost end of all slices and the outermost eigenvalue."""

MAX_END_RATIO = 10.0
"""Largest ratio of the ends of a slice: an eigenvalue keeps 1e-16 of the larger end."""

MIN_RELATIVE_WIDTH = 1e-12
"""Relative width below which an interval is not split: it holds a degenerate eigenvalue."""


class CountedShift(NamedTuple):
    """A shift σ, and the number of eigenvalues of J below it."""

    sigma: float
    n_below: int


class SpectralSlice(NamedTuple):
    """An interval [low, high) of eigenvalues λ, and the number of modes in it."""

    low: float
    high: float
    modes: int


def count_at(shift: SymmetricShift, sigma: float) -> CountedShift:
    """A shift with the number of eigenvalues below it.

    Raises:
        ZeroPivotError: J − σ is singular however σ is changed.
    """
    return CountedShift(sigma, shift.factor_at(sigma).n_below)


def slice_spectrum(shift: SymmetricShift, low: float, high: float) -> list[SpectralSlice]:
    """Slices that hold all eigenvalues of [low, high), ascending.

    Args:
        low, high: λ in k_N d^(1/2), 0 < low < high.

    Raises:
        ZeroPivotError: as `count_at`.
    """
    size = SLICE_MODES if shift.size < LARGE_MATRIX_SIZE else LARGE_MATRIX_SLICE_MODES
    start, stop = count_at(shift, low), count_at(shift, high)
    if stop.n_below <= start.n_below:
        return []
    return list(_slices(shift, *_tightened(shift, start, stop), size))


def _tightened(
    shift: SymmetricShift, start: CountedShift, stop: CountedShift
) -> tuple[CountedShift, CountedShift]:
    """The interval with its ends moved next to its lowest and its highest eigenvalue."""
    (low, n_below_low), (high, n_below_high) = start, stop
    inner = high
    while inner > OUTER_END_RATIO * low:
        middle = np.sqrt(low * inner)
        empty = shift.factor_at(middle).n_below == n_below_low
        low, inner = (middle, inner) if empty else (low, middle)
    inner = low
    while high > OUTER_END_RATIO * inner:
        middle = np.sqrt(high * inner)
        empty = shift.factor_at(middle).n_below == n_below_high
        high, inner = (middle, inner) if empty else (high, middle)
    return CountedShift(low, n_below_low), CountedShift(high, n_below_high)


def _slices(
    shift: SymmetricShift, start: CountedShift, stop: CountedShift, size: int
) -> Iterator[SpectralSlice]:
    """Split an interval until every part holds at most `size` eigenvalues and is easy to solve."""
    low, high = start.sigma, stop.sigma
    modes = stop.n_below - start.n_below
    if not modes:
        return
    pieces = -(-modes // size)
    if high > MAX_END_RATIO * low:
        middle = count_at(shift, np.sqrt(low * high))
    elif pieces > 1 and high - low > MIN_RELATIVE_WIDTH * high:
        target = start.n_below + modes * (pieces // 2) / pieces
        middle = shift_at_count(shift, start, stop, target, COUNT_TOLERANCE * size)
    elif _has_dense_neighbours(shift, low, high, modes):
        middle = count_at(shift, 0.5 * (low + high))
    else:
        yield SpectralSlice(low, high, modes)
        return
    yield from _slices(shift, start, middle, size)
    yield from _slices(shift, middle, stop, size)


def _has_dense_neighbours(shift: SymmetricShift, low: float, high: float, modes: int) -> bool:
    """Whether many eigenvalues lie just outside: the few inside would hardly be separated."""
    width = high - low
    if width <= MIN_RELATIVE_WIDTH * high:
        return False
    above = shift.factor_at(high + 0.5 * width).n_below
    below = shift.factor_at(max(low - 0.5 * width, low / 2)).n_below
    return above - below > MAX_NEIGHBOUR_RATIO * modes + NEIGHBOUR_ALLOWANCE


def shift_at_count(
    shift: SymmetricShift,
    start: CountedShift,
    stop: CountedShift,
    target: float,
    tolerance: float,
) -> CountedShift:
    """A shift between two others with about `target` eigenvalues below it, by interpolation.

    Args:
        start, stop: shifts with different counts, start.n_below ≤ target ≤ stop.n_below.
        tolerance: largest difference between its count and `target`; it may be larger where many
            eigenvalues lie within `MIN_RELATIVE_WIDTH`.

    Raises:
        ZeroPivotError: as `count_at`.
    """
    (low, n_below_low), (high, n_below_high) = start, stop
    while True:
        part = min(0.9, max(0.1, (target - n_below_low) / (n_below_high - n_below_low)))
        middle = np.sqrt(low * high) if high > 4.0 * low else low + part * (high - low)
        count = shift.factor_at(middle).n_below
        if abs(count - target) <= tolerance or high - low <= MIN_RELATIVE_WIDTH * high:
            return CountedShift(float(middle), count)
        if count < target:
            low, n_below_low = middle, count
        else:
            high, n_below_high = middle, count
