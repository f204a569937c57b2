"""All eigenpairs of a slice of the spectrum, by one factorisation and block Lanczos.

A Krylov space of (J − σ)⁻¹, σ at the middle of the slice (`linalg.block_lanczos`), is grown until
the slice holds as many converged eigenpairs as the inertia counts at its ends say: none is missed
and none is found twice. Slices are independent of each other: they are solved in any order, by any
number of processes, with the same result.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from grainmodes.linalg.block_lanczos import Eigenpairs, KrylovSpace
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.runtime.failures import MachineError
from grainmodes.runtime.processes import end_with_parent, is_single_threaded
from grainmodes.spectrum.eigenproblem import Eigenproblem
from grainmodes.spectrum.spectrum_slicing import MIN_RELATIVE_WIDTH, SpectralSlice

LANCZOS_BLOCK_SIZE = 16
"""Number of vectors in a Lanczos block."""

FIRST_KRYLOV_SIZE, MAX_KRYLOV_SIZE = 3.3, 7.0
"""Dimensions of the Krylov space per mode that is wanted: when it is first checked for converged
pairs, and when it is given up."""

Measure = TypeVar("Measure")


class SliceError(ArithmeticError):
    """The eigenpairs found in a slice are not as many as were counted."""


def eigenpairs_in_slice(
    shift: SymmetricShift, interval: SpectralSlice, seed: int = 0
) -> Eigenpairs:
    """All eigenpairs of a slice, ascending; a slice that does not converge is halved.

    Args:
        shift: of J; its factors are replaced.
        seed: of the random start of the Krylov space.

    Raises:
        SliceError: the pairs found are not as many as the counts say.
        ZeroPivotError: J − σ is singular however σ is changed.
    """
    low, high, modes = interval
    sigma = 0.5 * (low + high)
    max_size = int(MAX_KRYLOV_SIZE * modes) + 12 * LANCZOS_BLOCK_SIZE
    krylov = KrylovSpace(shift.factor_at(sigma), sigma, _block_size(shift), max_size, seed)
    n_below_sigma = shift.n_below
    krylov.grow(int(FIRST_KRYLOV_SIZE * modes) + LANCZOS_BLOCK_SIZE)
    while True:
        ritz = krylov.ritz_pairs()
        inside = np.flatnonzero((ritz.values >= low) & (ritz.values < high))
        if len(inside) == modes and ritz.converged[inside].all():
            return krylov.eigenpairs(ritz, inside)
        if krylov.is_full:
            break
        krylov.grow(krylov.size + 3 * LANCZOS_BLOCK_SIZE)
    if high - low <= MIN_RELATIVE_WIDTH * high:
        raise SliceError(
            f"slice of lambda from {low} to {high}: expected {modes} eigenpairs, got "
            f"{np.count_nonzero(ritz.converged[inside])} converged ones"
        )
    in_lower_half = n_below_sigma - shift.factor_at(low).n_below
    halves = (
        SpectralSlice(low, sigma, in_lower_half),
        SpectralSlice(sigma, high, modes - in_lower_half),
    )
    parts = [eigenpairs_in_slice(shift, half, seed) for half in halves if half.modes]
    return Eigenpairs(*(np.concatenate(columns, axis=-1) for columns in zip(*parts, strict=True)))


def _block_size(shift: SymmetricShift) -> int:
    """Number of vectors in a block: fewer where so many would soon exhaust the space."""
    return max(2, min(LANCZOS_BLOCK_SIZE, shift.size // 40))


def nearest_eigenpairs(
    shift: SymmetricShift, sigma: float, modes: int, seed: int = 0
) -> Eigenpairs:
    """The eigenpairs nearest σ, ascending, without the known zero modes.

    Args:
        shift: of J; its factors are replaced by those at σ.
        sigma: σ in k_N d^(1/2).
        modes: how many pairs.
        seed: of the random start of the Krylov space.

    Raises:
        SliceError: they did not converge.
        ZeroPivotError: J − σ is singular however σ is changed.
    """
    max_size = int(MAX_KRYLOV_SIZE * modes) + 16 * LANCZOS_BLOCK_SIZE
    krylov = KrylovSpace(shift.factor_at(sigma), sigma, _block_size(shift), max_size, seed)
    krylov.grow(int(FIRST_KRYLOV_SIZE * modes) + 2 * LANCZOS_BLOCK_SIZE)
    while True:
        ritz = krylov.ritz_pairs()
        nearest = np.argsort(np.abs(ritz.values - sigma), kind="stable")[:modes]
        if len(nearest) == modes and ritz.converged[nearest].all():
            return krylov.eigenpairs(ritz, nearest)
        if krylov.is_full:
            found = np.count_nonzero(ritz.converged[nearest])
            raise SliceError(
                f"modes nearest lambda = {sigma}: expected {modes} eigenpairs, got {found} "
                "converged ones"
            )
        krylov.grow(krylov.size + 2 * LANCZOS_BLOCK_SIZE)


def measure_slices(
    eigenproblem: Eigenproblem,
    backend: str,
    slices: list[SpectralSlice],
    measure: Callable[[NDArray[np.float64], NDArray[np.float64]], Measure],
    processes: int = 1,
) -> list[Measure]:
    """`measure(values, vectors)` of every slice, in their order; the vectors are not kept.

    Args:
        backend: see `linalg.backends.make_factorisation`.
        measure: a function that can be pickled, of λ (K,) and R (M, K).
        processes: number of processes that share the slices.

    Raises:
        SliceError: the pairs found in a slice are not as many as the counts say.
        MachineError: a process was killed.
    """
    if processes == 1:
        shift = eigenproblem.symmetric_shift(backend)
        return [measure(*eigenpairs_in_slice(shift, interval)) for interval in slices]
    arguments = eigenproblem, backend, measure
    context = get_context("fork" if is_single_threaded() else "spawn")
    with ProcessPoolExecutor(processes, context, _Worker.start, arguments) as pool:
        try:
            return list(pool.map(_Worker.run, slices))
        except BrokenProcessPool as error:
            raise MachineError(
                f"spectrum: expected {processes} processes that compute its slices, got one that "
                "was killed, perhaps for lack of memory; nothing was written"
            ) from error


class _Worker:
    """What one process keeps from slice to slice: a factorisation of its own.

    It is made with the first slice, because an error of an initializer is lost.
    """

    arguments: ClassVar[tuple[Eigenproblem, str]]
    measure: ClassVar[Callable[..., Any]]
    shift: ClassVar[SymmetricShift | None]

    @classmethod
    def start(cls, eigenproblem: Eigenproblem, backend: str, measure: Callable[..., Any]) -> None:
        end_with_parent()
        cls.arguments, cls.measure, cls.shift = (eigenproblem, backend), measure, None

    @classmethod
    def run(cls, interval: SpectralSlice) -> Any:
        if cls.shift is None:
            eigenproblem, backend = cls.arguments
            cls.shift = eigenproblem.symmetric_shift(backend)
        return cls.measure(*eigenpairs_in_slice(cls.shift, interval))
