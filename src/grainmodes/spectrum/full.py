"""All eigenvalues of a packing, and what is measured on every mode, by the cheapest method.

| method  | cost                                                 | chosen             |
| ------- | ---------------------------------------------------- | ------------------ |
| dense   | M³ operations, 5 M² numbers in memory                | M ≤ 5000           |
| slicing | M^1.5, sparse factors; the same numbers, certified   | larger symmetric J |

Spectrum slicing covers |λ| ≥ `zero_mode_cutoff`; eigenvalues λ < 0 are found as the positive ones
of −J. The modes between are zero modes to rounding: they get the eigenvalue 0 and no measures.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.packing.state import Packing
from grainmodes.parameters.spectra import DENSE_MODES_UP_TO, SpectrumChoices
from grainmodes.spectrum import dense, spectrum_slicing
from grainmodes.spectrum.eigenproblem import Eigenproblem, Numbers
from grainmodes.spectrum.measures import ModeMeasures
from grainmodes.spectrum.slice_eigenpairs import measure_slices

ZERO_MODE_CUTOFF = 1e-14
"""λ in k_N d^(1/2) below which a mode cannot be distinguished from a zero mode: ω t_0 = 1e-7."""

RELATIVE_ZERO_MODE_CUTOFF = 1e-15
"""The same relative to the bound of |λ|, which stiff tangential springs raise: k_T/k_N > 1."""


@dataclass(frozen=True)
class FullSpectrum:
    """All M eigenvalues in k_N d^(1/2), ascending by real part, with what was requested besides.

    `psi_rotational`, `participation_ratio` and `peak_grain`, the number of the grain that moves
    most, are (M,), NaN for the zero modes of spectrum slicing;
    `residual` is max_n ‖J R_n − λ_n R_n‖ with ‖R_n‖ = 1; `projection` (M, F) is R_n · f for the
    given forces; `modes` (M, M) has one column per mode, with rows (x, y[, ℓ]) grain by grain, and
    exists only where the method is "dense". What was not requested is None. `factorisation` names
    the sparse factorisation of spectrum slicing.
    """

    eigenvalue: Numbers
    psi_rotational: NDArray[np.float64] | None = None
    participation_ratio: NDArray[np.float64] | None = None
    peak_grain: NDArray[np.float64] | None = None
    residual: float | None = None
    projection: Numbers | None = None
    modes: Numbers | None = None
    method: str = "dense"
    factorisation: str = "none"


def packing_spectrum(
    packing: Packing,
    interaction: Interaction,
    threshold: int = 2,
    keep_rattlers: bool = False,
    modes: bool = True,
    forces: NDArray[np.float64] | None = None,
    choices: SpectrumChoices = SpectrumChoices(),
) -> FullSpectrum:
    """The `full_spectrum` of a packing.

    Args:
        threshold: a grain with at most so many contacts is a rattler, and is left out.
        keep_rattlers: keep the rattlers in J all the same.
        forces: (M, F) to project the modes on; the others as in `full_spectrum`.

    Raises:
        ValueError: as `full_spectrum` and `Eigenproblem.from_packing`, as are all other errors.
    """
    eigenproblem = Eigenproblem.from_packing(packing, interaction, threshold, keep_rattlers)
    return full_spectrum(eigenproblem, modes, forces, choices)


def full_spectrum(
    eigenproblem: Eigenproblem,
    modes: bool = True,
    forces: NDArray[np.float64] | None = None,
    choices: SpectrumChoices = SpectrumChoices(),
    processes: int = 1,
) -> FullSpectrum:
    """The spectrum of an eigenproblem.

    Args:
        modes: whether modes are measured; without them LAPACK computes the eigenvalues only.
        forces: (M, F) to project the modes on.
        choices: the method ("auto", "dense", "slicing") and the factorisation.
        processes: number of processes that share the slices; the result does not depend on it.

    Raises:
        ValueError: spectrum slicing is requested and J is not symmetric.
        SliceError: the eigenpairs of a slice are not as many as were counted.
        ZeroPivotError: J − σ is singular however σ is changed.
        numpy.linalg.LinAlgError: LAPACK did not converge.
    """
    forces = np.zeros((eigenproblem.size, 0)) if forces is None else forces
    if _method(eigenproblem, choices.method) == "slicing":
        return _by_slicing(eigenproblem, forces, choices.factorisation, processes)
    if not modes:
        return FullSpectrum(dense.eigenvalues(eigenproblem))
    values, vectors = dense.eigenpairs(eigenproblem)
    measures = ModeMeasures.from_eigenpairs(
        eigenproblem.matrix, eigenproblem.k, forces, values, vectors
    )
    return _from_measures(measures, modes=vectors)


def _method(eigenproblem: Eigenproblem, requested: str) -> str:
    if requested == "slicing" and not eigenproblem.symmetric:
        raise ValueError("method slicing: expected a symmetric Jacobian, got one with springs")
    if requested in ("dense", "slicing"):
        return requested
    large = eigenproblem.size > DENSE_MODES_UP_TO
    return "slicing" if eigenproblem.symmetric and large else "dense"


def _from_measures(measures: ModeMeasures, **more: Any) -> FullSpectrum:
    value, psi, p, peak, residual, projection = measures
    worst = float(residual.max(initial=0.0))
    return FullSpectrum(value, psi, p, peak, worst, projection, **more)


def _by_slicing(
    eigenproblem: Eigenproblem, forces: NDArray[np.float64], backend: str, processes: int
) -> FullSpectrum:
    shift, cutoff = eigenproblem.symmetric_shift(backend), zero_mode_cutoff(eigenproblem)
    negative, below = (shift.factor_at(end).n_below for end in (-cutoff, cutoff))
    parts = [_zero_modes(below - negative, forces.shape[1])]
    if negative:
        negated = replace(eigenproblem, matrix=-eigenproblem.matrix)
        negated_shift = negated.symmetric_shift(backend)
        found = _positive_modes(negated, negated_shift, forces, processes)
        parts = [part.negated() for part in reversed(found)] + parts
    parts += _positive_modes(eigenproblem, shift, forces, processes)
    measures = ModeMeasures.concatenated(parts)
    return _from_measures(measures, method="slicing", factorisation=shift.backend)


def zero_mode_cutoff(eigenproblem: Eigenproblem) -> float:
    """λ in k_N d^(1/2) up to which a mode of this J cannot be distinguished from a zero mode."""
    return max(ZERO_MODE_CUTOFF, RELATIVE_ZERO_MODE_CUTOFF * eigenproblem.bound)


def _positive_modes(
    eigenproblem: Eigenproblem,
    shift: SymmetricShift,
    forces: NDArray[np.float64],
    processes: int,
) -> list[ModeMeasures]:
    """The modes of every λ ≥ `zero_mode_cutoff`, slice by slice."""
    cutoff = zero_mode_cutoff(eigenproblem)
    slices = spectrum_slicing.slice_spectrum(shift, cutoff, eigenproblem.bound)
    measure = partial(ModeMeasures.from_eigenpairs, eigenproblem.matrix, eigenproblem.k, forces)
    return measure_slices(eigenproblem, shift.backend, slices, measure, processes)


def _zero_modes(count: int, forces: int) -> ModeMeasures:
    unknown, zero = np.full(count, np.nan), np.zeros(count)
    return ModeMeasures(zero, unknown, unknown, unknown, zero, np.zeros((count, forces)))
