"""How a spectrum is computed: the density of states, and ψ^R in bins, of symmetric J.

| method            | what it gives                        | setting                        |
| ----------------- | ------------------------------------ | ------------------------------ |
| dense symmetric   | every mode (LAPACK evd)              | modes                          |
| dense general     | every mode (LAPACK geev, as A, B)    | modes                          |
| slicing           | every mode, block Lanczos            | modes                          |
| counts            | modes below given edges, exactly     | bin_density of A's linear bins    |
| counted twice     | ψ^R in bins from counts in two σ     | cells a bin                    |
| kernel polynomial | both, from random vectors: not taken | moments                        |

Each quantity is measured where it is hardest. D(ω) at k_T/k_N = 1e-8, where the rotational band
lies far below the rounding of ‖J‖: its error is that of the integrated density of states, the mean
over modes of |ln ω/ω_ref| at the same rank, inside the range of A's bins. Counts are exact at their
edges, and their modes are put evenly between them, so that their error is the width of a bin: a
limited resolution, not a mistake. ψ^R at k_T/k_N = 1e-2, where the bands overlap and modes are
neither translational nor rotational: its error is the mean of |ψ^R_bin − ψ^R_ref| over the modes
within `BIN_EDGES`.

Reference: eigenpairs refined in extended precision (`refined_modes`) as long as J is small enough
for a dense matrix; beyond, `REFERENCE_REFINEMENT` times as many edges and cells as the finest point
has.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import DENSE_COUNTS_UP_TO, DENSE_MODES_UP_TO, SpectrumChoices
from grainmodes.spectrum import Eigenproblem, dense, full_spectrum
from grainmodes.spectrum.inertia_counts import count_below, rotational_sums
from grainmodes.spectrum.measures import rotational_fraction
from grainmodes.statistics.binning import fixed_edges
from measurements.accuracy import kernel_polynomial
from measurements.accuracy.diagram import (
    Diagram,
    DiagramRow,
    Size,
    TimedError,
    in_fresh_process,
    size_suffix,
    summarise,
    timed,
)
from measurements.accuracy.packings import compressed
from measurements.accuracy.refined_modes import refined_eigenpairs

PHI = 0.9
KT_OF_DENSITY, KT_OF_SHARE = 1e-8, 1e-2
"""k_T/k_N at which D(ω) and ψ^R are measured."""

BIN_EDGES = np.linspace(0.02, 1.3, 21)
"""Edges of the bins of ψ^R, over both bands."""

DEFAULT = SpectrumChoices()
BIN_DENSITIES = (0.02, 0.06, DEFAULT.bin_density, 0.6, 2.0)
CELLS = (1, DEFAULT.cells_per_bin, 4, 8)
MOMENTS = (125, 500, 2000)
REFERENCE_REFINEMENT = 4

MIN_CPU_SECONDS = 0.02
"""CPU seconds for which a short call is repeated, so that the clock can measure it."""

SLICING_UP_TO = 12_288
"""Degrees of freedom up to which all modes take minutes by spectrum slicing."""


class MethodResult(NamedTuple):
    """ω of every mode by rank (M,), and ψ^R in the bins of `BIN_EDGES`.

    Either is None if the method does not give it.
    """

    frequency: np.ndarray | None
    rotational: np.ndarray | None


def from_all_modes(values: np.ndarray, rotational: np.ndarray) -> MethodResult:
    """From λ (M,), ascending, and ψ^R (M,)."""
    below = np.searchsorted(values, BIN_EDGES**2)
    sums = np.diff(np.append(0.0, np.cumsum(np.nan_to_num(rotational)))[below])
    return MethodResult(np.sqrt(np.maximum(values, 0.0)), _mean(sums, np.diff(below)))


def _mean(sums: np.ndarray, modes: np.ndarray) -> np.ndarray:
    return np.divide(sums, modes, out=np.zeros(len(sums)), where=modes > 0)


def _weight(eigenproblem: Eigenproblem, vectors: np.ndarray) -> np.ndarray:
    return np.abs(vectors.reshape(eigenproblem.size // eigenproblem.k, eigenproblem.k, -1)) ** 2


def dense_symmetric(eigenproblem: Eigenproblem, modes: float) -> MethodResult:
    """Divide and conquer."""
    values, vectors = dense.eigenpairs(eigenproblem)
    return from_all_modes(values, rotational_fraction(_weight(eigenproblem, vectors)))


def dense_general(eigenproblem: Eigenproblem, modes: float) -> MethodResult:
    """The solver for general matrices, which the papers use."""
    values, vectors = dense.eigenpairs(replace(eigenproblem, symmetric=False))
    return from_all_modes(values.real, rotational_fraction(_weight(eigenproblem, vectors)))


def slicing(eigenproblem: Eigenproblem, modes: float) -> MethodResult:
    """Block Lanczos between exact counts."""
    found = full_spectrum(eigenproblem, choices=SpectrumChoices("slicing"))
    return from_all_modes(found.eigenvalue, found.psi_rotational)


def counted(eigenproblem: Eigenproblem, bin_density: float) -> MethodResult:
    """A's bins, their modes evenly between the edges."""
    edges = fixed_edges(KT_OF_DENSITY, bin_density)
    below = count_below(eigenproblem.symmetric_shift(), edges)
    return MethodResult(np.interp(_ranks(eigenproblem), below, edges), None)


def _ranks(eigenproblem: Eigenproblem) -> np.ndarray:
    return np.arange(eigenproblem.size) + 0.5


def counted_twice(eigenproblem: Eigenproblem, cells: float) -> MethodResult:
    """ψ^R from counts in two shifts."""
    shift = eigenproblem.symmetric_shift()
    below = count_below(shift, BIN_EDGES)
    sums = rotational_sums(shift, below, BIN_EDGES, eigenproblem.k, int(cells))
    return MethodResult(None, _mean(sums.total, np.diff(below)))


def stochastic(eigenproblem: Eigenproblem, moments: float) -> MethodResult:
    """The kernel polynomial method."""
    mu = kernel_polynomial.moments(eigenproblem, int(moments))
    at = fixed_edges(KT_OF_DENSITY, REFERENCE_REFINEMENT * BIN_DENSITIES[-1])
    below = kernel_polynomial.below(mu.all, mu, at**2)
    modes, sums = (
        np.diff(kernel_polynomial.below(part, mu, BIN_EDGES**2)) for part in (mu.all, mu.rotational)
    )
    return MethodResult(np.interp(_ranks(eigenproblem), below, at), _mean(sums, modes))


class Method(NamedTuple):
    """A method for spectra.

    Attributes:
        find: the method.
        gives: the quantities it gives.
        settings: the settings to try; empty: the only setting is the number of modes M.
        default: the default setting of the project; None: it has no settings.
        up_to: the largest M for which it takes minutes.
        default_for: the M for which it is the default of the project.
    """

    find: Callable[[Eigenproblem, float], MethodResult]
    gives: tuple[str, ...]
    settings: tuple[float, ...]
    default: float | None
    up_to: float
    default_for: range

    def at(self, modes: int) -> tuple[float, ...]:
        """The settings to try at M."""
        return (self.settings or (float(modes),)) if modes <= self.up_to else ()

    def is_default(self, setting: float, modes: int) -> bool:
        """Whether this setting is the default of the project at this M."""
        return modes in self.default_for and self.default in (None, setting)


SMALL, NEVER = range(DENSE_MODES_UP_TO + 1), range(0)
BEYOND_COUNTS = range(DENSE_COUNTS_UP_TO + 1, 10**9)
BEYOND_MODES = range(DENSE_MODES_UP_TO + 1, 10**9)

DENSITY, SHARE = r"$D(\omega)$", r"$\psi^R$"
BOTH = (DENSITY, SHARE)

METHODS = {
    "dense symmetric": Method(dense_symmetric, BOTH, (), None, DENSE_MODES_UP_TO, SMALL),
    "dense general": Method(dense_general, BOTH, (), None, DENSE_MODES_UP_TO, NEVER),
    "slicing": Method(slicing, BOTH, (), None, SLICING_UP_TO, BEYOND_MODES),
    "counts": Method(
        counted, (DENSITY,), BIN_DENSITIES, DEFAULT.bin_density, np.inf, BEYOND_COUNTS
    ),
    "counted twice": Method(
        counted_twice, (SHARE,), CELLS, DEFAULT.cells_per_bin, np.inf, BEYOND_MODES
    ),
    "kernel polynomial": Method(stochastic, BOTH, MOMENTS, None, np.inf, NEVER),
}


def reference(eigenproblem: Eigenproblem) -> MethodResult:
    """The result with which all methods are compared."""
    if eigenproblem.size > DENSE_MODES_UP_TO:
        finest = (
            counted(eigenproblem, REFERENCE_REFINEMENT * BIN_DENSITIES[-1]),
            counted_twice(eigenproblem, REFERENCE_REFINEMENT * CELLS[-1]),
        )
        return MethodResult(finest[0].frequency, finest[1].rotational)
    values, vectors = refined_eigenpairs(eigenproblem)
    return from_all_modes(values, rotational_fraction(_weight(eigenproblem, vectors)))


def measure(size: Size) -> Iterator[DiagramRow]:
    """The error of either quantity, of every method and setting."""
    for n in size.n:
        packings = [compressed(n, seed, PHI) for seed in range(size.seeds)]
        for quantity in QUANTITIES:
            for line in _measured(packings, quantity):
                yield line._replace(curve=f"{line.curve}{size_suffix(n, size)}")


def _measured(packings: list[Packing], quantity: str) -> Iterator[DiagramRow]:
    kt, error = QUANTITIES[quantity]
    interaction = Interaction.from_law(ContactLaw(kt=kt))
    problems = [Eigenproblem.from_packing(packing, interaction) for packing in packings]
    exact = [in_fresh_process(reference, eigenproblem).value for eigenproblem in problems]
    modes = min(eigenproblem.size for eigenproblem in problems)
    for name, method in METHODS.items():
        for setting in method.at(modes) if quantity in method.gives else ():
            done = in_fresh_process(timed_spectra, name, setting, problems)
            pairs = zip(done.value, exact, strict=True)
            samples = [
                TimedError(seconds, error(found, known)) for (found, seconds), known in pairs
            ]
            default = method.is_default(setting, modes)
            yield summarise(f"{name}, {quantity}", setting, samples, done.megabytes, default)


def timed_spectra(
    name: str, setting: float, problems: list[Eigenproblem]
) -> list[tuple[MethodResult, float]]:
    """The spectrum of every problem, and its CPU seconds."""
    problems[0].symmetric_shift().factor_at(1.0)
    find = METHODS[name].find
    return [timed(find, problem, setting, at_least=MIN_CPU_SECONDS) for problem in problems]


def error_of_density(found: MethodResult, exact: MethodResult) -> float:
    """Mean |ln ω/ω_ref| of the modes in A's bins."""
    low, *_, high = fixed_edges(KT_OF_DENSITY, DEFAULT.bin_density)
    inside = (exact.frequency > low) & (exact.frequency < high)
    ratio = np.maximum(found.frequency[inside], low) / exact.frequency[inside]
    return float(np.abs(np.log(ratio)).mean())


def error_of_share(found: MethodResult, exact: MethodResult) -> float:
    """Mean |ψ^R_bin − ψ^R_ref| of the modes within `BIN_EDGES`."""
    modes = np.histogram(exact.frequency, BIN_EDGES)[0]
    return float(np.abs(found.rotational - exact.rotational) @ modes / modes.sum())


QUANTITIES = {DENSITY: (KT_OF_DENSITY, error_of_density), SHARE: (KT_OF_SHARE, error_of_share)}
"""Quantity → the k_T/k_N at which it is measured, and its error."""

DIAGRAM = Diagram(
    title=r"Spectra, φ = 0.90: $D(\omega)$ at $k_T/k_N = 10^{-8}$, $\psi^R$ at $10^{-2}$",
    setting="modes, bin density, cells a bin, or moments",
    unit="spectrum",
    error=r"$|\ln\,\omega/\omega_{\rm ref}|$ of a mode; $|\psi^R - \psi^R_{\rm ref}|$ of a bin",
    reference="eigenpairs refined in extended precision; at large N 4 times the edges and cells",
    small=Size((256, 1024), 1),
    large=Size((4096, 16384, 65536), 1),
    measure=measure,
)
