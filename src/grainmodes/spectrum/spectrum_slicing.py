"""Eigenpairs beyond the size of dense matrices: the spectrum in windows, each certified complete.

Counts split the spectrum into windows [low, high) of about `WINDOW` modes. One factorisation at the
middle of a window and block Lanczos (`lanczos`) give its eigenpairs; the counts at its two ends say
how many there must be, so that none is missed and none is found twice. Windows know nothing of each
other: they are computed in any order, by any number of processes, with the same result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import NamedTuple

import numpy as np

from grainmodes.linalg.block_lanczos import Eigenpairs, KrylovSpace
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.spectrum.problem import Problem

WINDOW = 150
"""Modes of a window where the basis of its Krylov space fits into the cache; elsewhere 60."""

LARGE = 30_000
"""Degrees of freedom from which windows are the smaller ones."""

BLOCK = 16
"""Vectors of a Lanczos block."""

FIRST, LARGEST = 3.3, 7.0
"""Dimensions of the Krylov space per mode: when the first look is taken, and when we give up."""

SLACK = 0.1
"""How far, in parts of a window, the count at its end may be from what was aimed at."""

CROWD = 4
"""Eigenvalues within twice the half-width of a window, per mode of it, that block Lanczos can still
tell apart from those inside; an even density has 2."""

LOOSE = 1.05
"""Ratio of the outermost ends of all windows to the outermost eigenvalues, at most."""

WIDE = 10.0
"""Largest ratio of the ends of a window: an eigenvalue keeps 1e-16 of the larger one."""

RESOLUTION = 1e-12
"""Relative width below which an interval is not divided further: a degenerate eigenvalue."""


class WindowError(ArithmeticError):
    """The eigenpairs found in a window are not those counted."""


class Window(NamedTuple):
    """Eigenvalues from `low` to below `high`, of which there are `modes`."""

    low: float
    high: float
    modes: int


def split(shift: SymmetricShift, low: float, high: float) -> list[Window]:
    """Windows that hold all eigenvalues of [low, high), ascending; 0 < low < high."""
    size = WINDOW if shift.size < LARGE else WINDOW * 2 // 5
    start, stop = (low, shift.factor_at(low).n_below), (high, shift.factor_at(high).n_below)
    if stop[1] <= start[1]:
        return []
    return list(_split(shift, *_tightened(shift, start, stop), size))


def _tightened(shift: SymmetricShift, start, stop):
    """The ends of an interval moved to where its lowest and highest eigenvalue are."""
    (low, below_low), (high, below_high) = start, stop
    inner = high
    while inner > LOOSE * low:
        middle = np.sqrt(low * inner)
        low, inner = (
            (middle, inner) if shift.factor_at(middle).n_below == below_low else (low, middle)
        )
    inner = low
    while high > LOOSE * inner:
        middle = np.sqrt(high * inner)
        high, inner = (
            (middle, inner) if shift.factor_at(middle).n_below == below_high else (high, middle)
        )
    return (low, below_low), (high, below_high)


def _split(shift: SymmetricShift, start, stop, size: int) -> Iterator[Window]:
    (low, below_low), (high, below_high) = start, stop
    modes = below_high - below_low
    if not modes:
        return
    pieces = -(-modes // size)
    if high > WIDE * low:
        middle = np.sqrt(low * high), shift.factor_at(np.sqrt(low * high)).n_below
    elif pieces > 1 and high - low > RESOLUTION * high:
        aim = below_low + modes * (pieces // 2) / pieces
        middle = between(shift, start, stop, aim, SLACK * size)
    elif _crowded(shift, low, high, modes):
        middle = 0.5 * (low + high), shift.factor_at(0.5 * (low + high)).n_below
    else:
        yield Window(low, high, modes)
        return
    yield from _split(shift, start, middle, size)
    yield from _split(shift, middle, stop, size)


def _crowded(shift: SymmetricShift, low: float, high: float, modes: int) -> bool:
    """Whether many eigenvalues lie just outside: those of a window beside a band are hard."""
    width = high - low
    if width <= RESOLUTION * high:
        return False
    around = (
        shift.factor_at(high + 0.5 * width).n_below
        - shift.factor_at(max(low - 0.5 * width, low / 2)).n_below
    )
    return around > CROWD * modes + CROWD * BLOCK


def between(shift: SymmetricShift, start, stop, aim: float, slack: float) -> tuple[float, int]:
    """A shift with about `aim` eigenvalues below it, and how many there are.

    `start` and `stop` are shifts with their counts; the next one is interpolated between them.
    """
    (low, below_low), (high, below_high) = start, stop
    while True:
        part = min(0.9, max(0.1, (aim - below_low) / (below_high - below_low)))
        middle = np.sqrt(low * high) if high > 4.0 * low else low + part * (high - low)
        count = shift.factor_at(middle).n_below
        if abs(count - aim) <= slack or high - low <= RESOLUTION * high:
            return float(middle), count
        if count < aim:
            low, below_low = middle, count
        else:
            high, below_high = middle, count


def eigenpairs(shift: SymmetricShift, window: Window, seed: int = 0) -> Eigenpairs:
    """All eigenpairs of a window, ascending; one that resists is halved.

    Raises:
        WindowError: the pairs found are not as many as the counts say.
    """
    low, high, modes = window
    sigma = 0.5 * (low + high)
    krylov = KrylovSpace(
        shift.factor_at(sigma), sigma, _block(shift), int(LARGEST * modes) + 12 * BLOCK, seed
    )
    below = shift.n_below
    krylov.grow(int(FIRST * modes) + BLOCK)
    while True:
        ritz = krylov.ritz_pairs()
        inside = np.flatnonzero((ritz.values >= low) & (ritz.values < high))
        if len(inside) == modes and ritz.converged[inside].all():
            return krylov.eigenpairs(ritz, inside)
        if krylov.is_full:
            break
        krylov.grow(krylov.size + 3 * BLOCK)
    if high - low <= RESOLUTION * high:
        raise WindowError(
            f"{np.count_nonzero(ritz.converged[inside])} eigenpairs converged between {low} and "
            f"{high}, where {modes} were counted"
        )
    lower = below - shift.factor_at(low).n_below
    halves = Window(low, sigma, lower), Window(sigma, high, modes - lower)
    parts = [eigenpairs(shift, half, seed) for half in halves if half.modes]
    return Eigenpairs(*(np.concatenate(columns, axis=-1) for columns in zip(*parts, strict=True)))


def _block(shift: SymmetricShift) -> int:
    """Vectors of a block: fewer where so many would soon exhaust the space."""
    return max(2, min(BLOCK, shift.size // 40))


def nearest(shift: SymmetricShift, sigma: float, modes: int, seed: int = 0) -> Eigenpairs:
    """The `modes` eigenpairs nearest σ, ascending, the known zero modes left out.

    Raises:
        WindowError: they did not converge.
    """
    largest = int(LARGEST * modes) + 16 * BLOCK
    krylov = KrylovSpace(shift.factor_at(sigma), sigma, _block(shift), largest, seed)
    krylov.grow(int(FIRST * modes) + 2 * BLOCK)
    while True:
        ritz = krylov.ritz_pairs()
        close = np.argsort(np.abs(ritz.values - sigma), kind="stable")[:modes]
        if len(close) == modes and ritz.converged[close].all():
            return krylov.eigenpairs(ritz, close)
        if krylov.is_full:
            found = np.count_nonzero(ritz.converged[close])
            raise WindowError(f"{found} of {modes} eigenpairs nearest {sigma} converged")
        krylov.grow(krylov.size + 2 * BLOCK)


def measured(
    problem: Problem,
    backend: str,
    windows: list[Window],
    measure: Callable[[np.ndarray, np.ndarray], tuple],
    processes: int = 1,
) -> list[tuple]:
    """`measure(values, vectors)` of every window, in their order; vectors are not kept.

    Raises:
        WindowError: the pairs found in a window are not as many as the counts say.
        MemoryError: a process died.
    """
    if processes == 1:
        shift = problem.shift(backend)
        return [measure(*eigenpairs(shift, window)) for window in windows]
    given = problem, backend, measure
    with ProcessPoolExecutor(processes, get_context("spawn"), _Worker.start, given) as pool:
        try:
            return list(pool.map(_Worker.run, windows))
        except BrokenProcessPool as error:
            raise MemoryError("a process that computes windows was killed") from error


class _Worker:
    """A process with a factorisation of its own."""

    shift: SymmetricShift
    measure: Callable

    @classmethod
    def start(cls, problem: Problem, backend: str, measure) -> None:
        cls.shift, cls.measure = problem.shift(backend), measure

    @classmethod
    def run(cls, window: Window):
        return cls.measure(*eigenpairs(cls.shift, window))
