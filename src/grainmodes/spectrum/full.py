"""All eigenvalues of a packing, and what is measured on every mode, by the cheapest method.

| method  | what it costs                                        | chosen             |
| ------- | ---------------------------------------------------- | ------------------ |
| dense   | M³, 5 M² numbers                                     | M ≤ 5000           |
| windows | M^1.5, sparse factors; the same numbers, certified   | larger symmetric J |

Windows cover |λ| ≥ `floor`, those of λ < 0 as the positive eigenvalues of −J; of the modes between,
which are zero modes to rounding, they give the number, an eigenvalue 0 and nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from grainmodes.parameters.spectra import DENSE_MODES_UP_TO, SpectrumChoices
from grainmodes.spectrum import dense, spectrum_slicing
from grainmodes.spectrum.measures import Measured
from grainmodes.spectrum.problem import Problem

FLOOR = 1e-14
"""λ of the lowest safe edge, ω t_0 = 1e-7: what lies below cannot be told from a zero mode."""

ROUNDING = 1e-15
"""The same relative to the bound of |λ|, which stiff tangential springs raise: k_T/k_N > 1."""


@dataclass(frozen=True)
class Spectrum:
    """Eigenvalues (M,), ascending by real part, k_N d^(1/2); the rest is None if not asked for.

    `psi_rotational` and `participation_ratio` are (M,), NaN for zero modes between the windows;
    `residual` is max_n ‖J R_n − λ_n R_n‖ with ‖R_n‖ = 1; `projection` (M, F) is R_n · f of the
    forces asked for; `modes` is (M, M), one column a mode, degrees of freedom (x, y[, ℓ]) grain by
    grain, and exists only where the method is "dense". `factorisation` is the one of the windows.
    """

    eigenvalue: np.ndarray
    psi_rotational: np.ndarray | None = None
    participation_ratio: np.ndarray | None = None
    residual: float | None = None
    projection: np.ndarray | None = None
    modes: np.ndarray | None = None
    method: str = "dense"
    factorisation: str = "none"


def full_spectrum(
    problem: Problem,
    modes: bool = True,
    forces: np.ndarray | None = None,
    choices: SpectrumChoices = SpectrumChoices(),
    processes: int = 1,
) -> Spectrum:
    """The spectrum of a problem; without `modes` only the eigenvalues.

    Args:
        forces: (M, F) to project the modes on.
        choices: method ("auto", "dense", "slicing") and factorisation.
        processes: processes that share the windows; the numbers do not depend on it.

    Raises:
        ValueError: windows are asked for and J is not symmetric.
        ArithmeticError: eigenpairs are missing (spectrum_slicing).
        numpy.linalg.LinAlgError: LAPACK did not converge.
    """
    forces = np.zeros((problem.size, 0)) if forces is None else forces
    if _method(problem, choices.method) == "slicing":
        return _by_windows(problem, forces, choices.factorisation, processes)
    if not modes:
        return Spectrum(dense.eigenvalues(problem))
    values, vectors = dense.eigenpairs(problem)
    measured = Measured.of(problem.matrix, problem.k, forces, values, vectors)
    return _spectrum(measured, modes=vectors)


def _method(problem: Problem, asked: str) -> str:
    if asked == "slicing" and not problem.symmetric:
        raise ValueError("method: expected dense for a Jacobian that is not symmetric, got windows")
    if asked in ("dense", "slicing"):
        return asked
    return "slicing" if problem.symmetric and problem.size > DENSE_MODES_UP_TO else "dense"


def _spectrum(measured: Measured, **more) -> Spectrum:
    value, psi, p, residual, projection = measured
    return Spectrum(value, psi, p, float(residual.max(initial=0.0)), projection, **more)


def _by_windows(problem: Problem, forces, backend: str, processes: int) -> Spectrum:
    shift, edge = problem.shift(backend), floor(problem)
    unstable, below = (shift.factor_at(end).n_below for end in (-edge, edge))
    found = [_zero_modes(below - unstable, forces.shape[1])]
    if unstable:
        turned = replace(problem, matrix=-problem.matrix)
        below_zero = _window_by_window(turned, turned.shift(backend), forces, processes)
        found = [part.turned() for part in reversed(below_zero)] + found
    found += _window_by_window(problem, shift, forces, processes)
    return _spectrum(Measured.joined(found), method="slicing", factorisation=shift.backend)


def floor(problem: Problem) -> float:
    """λ up to which an eigenvalue of this matrix cannot be told from a zero mode."""
    return max(FLOOR, ROUNDING * problem.bound)


def _window_by_window(problem: Problem, shift, forces, processes: int) -> list[Measured]:
    """The modes of every λ ≥ `floor`."""
    parts = spectrum_slicing.split(shift, floor(problem), problem.bound)
    measure = partial(Measured.of, problem.matrix, problem.k, forces)
    return spectrum_slicing.measured(problem, shift.backend, parts, measure, processes)


def _zero_modes(count: int, forces: int) -> Measured:
    unknown, zero = np.full(count, np.nan), np.zeros(count)
    return Measured(zero, unknown, unknown, zero, np.zeros((count, forces)))
