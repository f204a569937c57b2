"""Which work a stage does on one sample: the name of a law → how many units of it.

Spectra follow the rules by which the stages choose a method: LAPACK up to a size; beyond, counts
at the edges of bins, or slices of eigenpairs. ψ^R of a bin is counted in `cells_per_bin` cells:
each at its end on the diagonal and at two corners, and pairs of cells once more at two, four
counts a cell. p takes the eigenpairs of a bin, at most `modes_per_bin`. A shear is priced per step
of 1e-4, with the complex pairs of its events and λ_min of its states where they are computed;
complex pairs per state, a release per million steps of all its runs.
"""

from __future__ import annotations

from collections.abc import Callable

from grainmodes.cost.table import Table
from grainmodes.parameters.factors import PARDISO_FROM
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.release import Release
from grainmodes.parameters.spectra import (
    BINNED,
    DENSE_COUNTS_UP_TO,
    DENSE_MODES_UP_TO,
    HIGHEST_BINS,
    HIGHEST_DIVISIONS,
    LOGARITHMIC_BINS,
    ROTATIONAL_DIVISIONS,
    SpectrumChoices,
)
from grainmodes.parameters.stages import STAGES
from grainmodes.parameters.strain import MAX_PAIR_DOF, Shear
from grainmodes.runtime import pardiso

USUAL_STEP = 1e-4
"""The step of strain in which a shear is priced, with the brackets of its events."""

EVENTS_PER_STRAIN = 300.0
"""Plastic events per unit of strain: 165 to γ = 0.5, 14 to 23 to γ = 0.1 (N = 128, paper B)."""

USUAL_RATE = 0.02
"""ω_i, in 1/t_0, of the state that is released where a scene lists no rates."""

NOISE_GROWTH_TIMES = 20.0
"""Time after which M has grown out of noise, in 1/ω_i."""


def work(
    stage: str, kind: str, n: int, kt: float, protocol: Protocol, table: Table
) -> dict[str, float]:
    """Units of work of a stage on one sample of n grains.

    Args:
        stage: a name of the table of stages, `parameters.stages`.
        kind: of the spectrum at this point.
        kt: k_T / k_N; at 0 there is no rotation and no band of it.
    """
    entry = STAGES[stage]
    if entry.work in ("spectrum", "two spectra"):
        times = 2 if entry.work == "two spectra" else 1
        kind = kind if entry.work == "spectrum" else "counts"
        once = _spectrum(kind, n, kt, protocol.spectrum, table)
        return {name: times * units for name, units in once.items()}
    if entry.work == "shear":
        return _shear(n, kt, protocol.shear)
    return {stage: UNITS[entry.work](protocol)}


def _shear(n: int, kt: float, choices: Shear) -> dict[str, float]:
    """Steps of 1e-4, events whose complex pairs are counted, and states whose λ_min is computed."""
    units = {"shear": choices.strain / USUAL_STEP}
    if kt > 0.0 and degrees_of_freedom(n, kt) <= MAX_PAIR_DOF:
        units["event_pairs"] = EVENTS_PER_STRAIN * choices.strain
    if choices.lowest_eigenvalue == "states":
        units["lowest_eigenvalue"] = choices.strain / choices.step
    return units


def _runs(choices: Release, rates: tuple[float, ...]) -> float:
    """Millions of steps of all runs of a release: of every state one without damping, one for every
    damping, and one from noise, which ends with the growth."""
    times = [
        (1 + len(choices.dampings)) * max(choices.duration / rate, choices.min_time)
        + min(choices.duration, NOISE_GROWTH_TIMES) / rate
        for rate in rates or (USUAL_RATE,)
    ]
    return 1e-6 * sum(times) / choices.time_step


UNITS: dict[str, Callable[[Protocol], float]] = {
    "sample": lambda protocol: 1.0,
    "usual steps": lambda protocol: protocol.shear.strain / USUAL_STEP,
    "steps": lambda protocol: protocol.shear.strain / protocol.shear.step,
    "runs": lambda protocol: _runs(protocol.release, protocol.complex_pairs.release_rates),
}
"""`work` of an entry of the table of stages → units of its growth law in one sample."""


def degrees_of_freedom(n: int, kt: float) -> int:
    """Number of modes of n grains, rattlers included."""
    return n * (3 if kt > 0.0 else 2)


def bins(kt: float, bin_density: float) -> float:
    """About how many bins A's recipe makes."""
    rotational = ROTATIONAL_DIVISIONS if kt > 0.0 else 0
    return LOGARITHMIC_BINS - HIGHEST_BINS + bin_density * (HIGHEST_DIVISIONS + rotational)


def _spectrum(kind: str, n: int, kt: float, choices: SpectrumChoices, table: Table):
    modes, edges = degrees_of_freedom(n, kt), bins(kt, choices.bin_density) + 1
    if _dense(kind, modes, choices.method, table):
        return {"dense_values" if kind in ("counts", "eigenvalues") else "dense_modes": 1}
    backend = _backend(choices.factorisation, modes)
    if kind == "counts":
        return {f"count_{backend}": edges}
    if kind == "binned_averages":
        return {
            f"count_{backend}": edges * (4 * choices.cells_per_bin if kt > 0.0 else 1),
            f"window_{backend}": min(modes, edges * choices.modes_per_bin),
        }
    return {f"window_{backend}": modes}


def _dense(kind: str, modes: int, method: str, table: Table) -> bool:
    named = method == "slicing" or (method == "inertia_counts" and kind in BINNED)
    limit = DENSE_COUNTS_UP_TO if kind == "counts" else DENSE_MODES_UP_TO
    return method == "dense" or (not named and modes <= limit)


def _backend(asked: str, modes: int) -> str:
    if asked != "auto":
        return asked
    return "pardiso" if modes >= PARDISO_FROM and pardiso.is_installed() else "superlu"
