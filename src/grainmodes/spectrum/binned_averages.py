"""Averages over bins of frequency at any N: exact counts, ψ^R and p with their errors.

| what     | how, in a bin of many modes                            | error                        |
| -------- | ------------------------------------------------------ | ---------------------------- |
| number   | counts at its edges (`counting`)                       | none                         |
| mean ψ^R | counts in two shifts (`counting`)                      | of chance and of step        |
| mean p   | modes nearest to a few shifts spread over the bin      | scatter between these groups |

A bin of few modes (at most `modes_per_bin`) gets all its eigenpairs and no error; so does every bin
of a matrix small enough for LAPACK.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from grainmodes.parameters.spectra import DENSE_COUNTS_UP_TO, DENSE_MODES_UP_TO, SpectrumChoices
from grainmodes.spectrum import dense, spectrum_slicing
from grainmodes.spectrum.inertia_counts import Sums, counts, rotational_sums
from grainmodes.spectrum.measures import participation_ratio, rotational_fraction
from grainmodes.spectrum.problem import Problem

GROUPS = 8
"""Shifts in a bin around which modes are sampled."""

TWO_SIGMA = 0.9772499
"""Part of a normal distribution below two standard deviations."""


@dataclass(frozen=True)
class Bands:
    """Modes in bins of ω; the averages are None if not asked for, NaN in an empty bin.

    `edge` (B + 1,) 1/t_0; `count` (B,) int; `below`: modes below the first edge, zero modes
    included; `modes`: all modes. `psi_rotational`, `participation_ratio` (B,) with their standard
    errors.
    """

    edge: np.ndarray
    count: np.ndarray
    below: int
    modes: int
    psi_rotational: np.ndarray | None = None
    psi_rotational_error: np.ndarray | None = None
    participation_ratio: np.ndarray | None = None
    participation_ratio_error: np.ndarray | None = None
    method: str = "dense"
    factorisation: str = "none"


def band_averages(
    problem: Problem,
    edges: np.ndarray,
    averages: bool,
    choices: SpectrumChoices = SpectrumChoices(),
) -> Bands:
    """Modes in the bins between `edges` (B + 1,) 1/t_0, with or without averages of ψ^R and p.

    Raises:
        ValueError: J is not symmetric: a frequency is then no square root of an eigenvalue.
    """
    if not problem.symmetric:
        raise ValueError(
            "expected a symmetric Jacobian for bins of frequency, got one with springs"
        )
    limit = DENSE_MODES_UP_TO if averages else DENSE_COUNTS_UP_TO
    small = choices.method == "auto" and problem.size <= limit
    if small or choices.method == "dense":
        return _dense(problem, edges, averages)
    shift = problem.shift(choices.factorisation)
    below = counts(shift, edges)
    count = np.diff(below)
    given = {"method": "inertia_counts", "factorisation": shift.backend}
    if averages:
        given |= _averages(shift, problem, edges, below, choices)
    return Bands(edges, count, int(below[0]), problem.size, **given)


def _dense(problem: Problem, edges: np.ndarray, averages: bool) -> Bands:
    values, vectors = dense.eigenpairs(problem) if averages else (dense.eigenvalues(problem), None)
    below = np.searchsorted(values, edges**2)
    count = np.diff(below)
    given = {}
    if averages:
        weight = _weight(problem, vectors)
        for name, of in (
            ("psi_rotational", rotational_fraction),
            ("participation_ratio", participation_ratio),
        ):
            total = np.diff(np.append(0.0, np.cumsum(of(weight)))[below])
            given |= _named(name, _mean(Sums(total, np.zeros(len(total))), count))
    return Bands(edges, count, int(below[0]), problem.size, **given)


def _weight(problem: Problem, vectors: np.ndarray) -> np.ndarray:
    return vectors.reshape(problem.size // problem.k, problem.k, -1) ** 2


def _averages(shift, problem: Problem, edges, below, choices: SpectrumChoices) -> dict:
    count = np.diff(below)
    psi = _mean(rotational_sums(shift, below, edges, problem.k, choices.cells_per_bin), count)
    p = np.full((2, len(count)), np.nan)
    for number in np.flatnonzero(count):
        low, high = edges[number : number + 2] ** 2
        if count[number] <= choices.modes_per_bin:
            window = spectrum_slicing.Window(low, high, int(count[number]))
            weight = _weight(problem, spectrum_slicing.eigenpairs(shift, window).vectors)
            psi[:, number] = rotational_fraction(weight).mean(), 0.0
            p[:, number] = participation_ratio(weight).mean(), 0.0
        else:
            ends = (low, below[number]), (high, below[number + 1])
            p[:, number] = _sampled(shift, problem, *ends, choices.modes_per_bin, int(number))
    return _named("psi_rotational", psi) | _named("participation_ratio", p)


def _sampled(shift, problem: Problem, start, stop, modes: int, seed: int) -> tuple[float, float]:
    """Mean p of a bin, and its standard error, from groups of modes at stratified ranks."""
    (low, below_low), (high, below_high) = start, stop
    at = (np.arange(GROUPS) + np.random.default_rng(seed).random(GROUPS)) / GROUPS
    group = max(1, modes // GROUPS)
    means = []
    for rank in below_low + (below_high - below_low) * at:
        sigma, _ = spectrum_slicing.between(shift, start, stop, rank, slack=0.5 * group)
        found = spectrum_slicing.nearest(shift, sigma, group)
        inside = (found.values >= low) & (found.values < high)
        if inside.any():
            means.append(participation_ratio(_weight(problem, found.vectors[:, inside])).mean())
    if len(means) < 2:
        return means[0] if means else np.nan, np.inf
    # Few groups: two errors hold as much of Student's t as two of the normal law.
    spread = np.std(means, ddof=1) / np.sqrt(len(means))
    return np.mean(means), 0.5 * stdtrit(len(means) - 1, TWO_SIGMA) * spread


def _mean(sums: Sums, count: np.ndarray) -> np.ndarray:
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(count > 0, np.array(sums) / count, np.nan)


def _named(name: str, mean: np.ndarray) -> dict[str, np.ndarray]:
    return {name: mean[0], f"{name}_error": mean[1]}
