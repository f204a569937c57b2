"""Averages over bins of frequency at any N: exact counts, ψ^R and p with their errors.

| what     | how, in a bin of many modes                         | error                      |
| -------- | --------------------------------------------------- | -------------------------- |
| number   | inertia counts at its edges (`inertia_counts`)      | none                       |
| mean ψ^R | inertia counts in two shifts (`inertia_counts`)     | of chance and of cell size |
| mean p   | modes nearest to a few shifts spread over the bin   | scatter between the groups |

In a bin of few modes (at most `modes_per_bin`) all eigenpairs are computed, and the means have no
error. The same holds for every bin of a matrix that is small enough for LAPACK.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.parameters.spectra import DENSE_COUNTS_UP_TO, DENSE_MODES_UP_TO, SpectrumChoices
from grainmodes.spectrum import dense, slice_eigenpairs
from grainmodes.spectrum.eigenproblem import Eigenproblem, Numbers
from grainmodes.spectrum.inertia_counts import count_below, rotational_sums
from grainmodes.spectrum.measures import participation_ratio, rotational_fraction
from grainmodes.spectrum.spectrum_slicing import CountedShift, SpectralSlice, shift_at_count
from grainmodes.statistics.binning import BinSums

SAMPLED_GROUPS = 8
"""Number of shifts in a bin around which modes are sampled."""

TWO_SIGMA_QUANTILE = 0.9772499
"""Probability that a normal variable is less than two standard deviations above its mean."""


@dataclass(frozen=True)
class BinnedAverages:
    """Modes in bins of ω; the averages are None if not requested, NaN in an empty bin.

    `edge` (B + 1,) 1/t_0; `count` (B,) int; `below`: number of modes below the first edge, zero
    modes included; `modes`: number of all modes. `psi_rotational` and `participation_ratio` (B,)
    with their standard errors.
    """

    edge: NDArray[np.float64]
    count: NDArray[np.int64]
    below: int
    modes: int
    psi_rotational: NDArray[np.float64] | None = None
    psi_rotational_error: NDArray[np.float64] | None = None
    participation_ratio: NDArray[np.float64] | None = None
    participation_ratio_error: NDArray[np.float64] | None = None
    method: str = "dense"
    factorisation: str = "none"


def average_in_bins(
    eigenproblem: Eigenproblem,
    edges: NDArray[np.float64],
    averages: bool,
    choices: SpectrumChoices = SpectrumChoices(),
) -> BinnedAverages:
    """The modes in bins of frequency, with or without averages of ψ^R and p.

    Args:
        edges: (B + 1,) of the bins, 1/t_0, ascending, above zero.
        averages: whether ψ^R and p are averaged.

    Raises:
        ValueError: J is not symmetric: a frequency is then not the root of an eigenvalue.
        ZeroPivotError: J − ω² is singular however ω² is changed.
        SliceError: eigenpairs did not converge.
        numpy.linalg.LinAlgError: LAPACK did not converge.
    """
    if not eigenproblem.symmetric:
        raise ValueError(
            "bins of frequency: expected a symmetric Jacobian, got springs with s != 0"
        )
    limit = DENSE_MODES_UP_TO if averages else DENSE_COUNTS_UP_TO
    small = choices.method == "auto" and eigenproblem.size <= limit
    if small or choices.method == "dense":
        return _from_dense(eigenproblem, edges, averages)
    shift = eigenproblem.symmetric_shift(choices.factorisation)
    n_below = count_below(shift, edges)
    columns: dict[str, Any] = {"method": "inertia_counts", "factorisation": shift.backend}
    if averages:
        columns |= _averages(shift, eigenproblem, edges, n_below, choices)
    return BinnedAverages(edges, np.diff(n_below), int(n_below[0]), eigenproblem.size, **columns)


def _from_dense(
    eigenproblem: Eigenproblem, edges: NDArray[np.float64], averages: bool
) -> BinnedAverages:
    if averages:
        values, vectors = dense.eigenpairs(eigenproblem)
    else:
        values = dense.eigenvalues(eigenproblem)
    n_below = np.searchsorted(values, edges**2)
    count = np.diff(n_below)
    columns: dict[str, Any] = {}
    if averages:
        weight = _weight(eigenproblem, vectors)
        for name, measure in (
            ("psi_rotational", rotational_fraction),
            ("participation_ratio", participation_ratio),
        ):
            total = np.diff(np.append(0.0, np.cumsum(measure(weight)))[n_below])
            columns |= _named(name, _mean(BinSums(total, np.zeros(len(total))), count))
    return BinnedAverages(edges, count, int(n_below[0]), eigenproblem.size, **columns)


def _weight(eigenproblem: Eigenproblem, vectors: Numbers) -> NDArray[np.float64]:
    """|R|² of modes (kN, M) as (N, k, M)."""
    return np.abs(vectors.reshape(eigenproblem.size // eigenproblem.k, eigenproblem.k, -1)) ** 2


def _averages(
    shift: SymmetricShift,
    eigenproblem: Eigenproblem,
    edges: NDArray[np.float64],
    n_below: NDArray[np.int64],
    choices: SpectrumChoices,
) -> dict[str, NDArray[np.float64]]:
    """Mean ψ^R and mean p of every bin, with their errors."""
    count = np.diff(n_below)
    sums = rotational_sums(shift, n_below, edges, eigenproblem.k, choices.cells_per_bin)
    psi, p = _mean(sums, count), np.full((2, len(count)), np.nan)
    for number in np.flatnonzero(count):
        low, high = edges[number : number + 2] ** 2
        if count[number] <= choices.modes_per_bin:
            interval = SpectralSlice(low, high, int(count[number]))
            found = slice_eigenpairs.eigenpairs_in_slice(shift, interval)
            weight = _weight(eigenproblem, found.vectors)
            psi[:, number] = rotational_fraction(weight).mean(), 0.0
            p[:, number] = participation_ratio(weight).mean(), 0.0
        else:
            start = CountedShift(low, n_below[number])
            stop = CountedShift(high, n_below[number + 1])
            modes, seed = choices.modes_per_bin, int(number)
            p[:, number] = _sampled(shift, eigenproblem, start, stop, modes, seed)
    return _named("psi_rotational", psi) | _named("participation_ratio", p)


def _sampled(
    shift: SymmetricShift,
    eigenproblem: Eigenproblem,
    start: CountedShift,
    stop: CountedShift,
    modes: int,
    seed: int,
) -> tuple[float, float]:
    """Mean p of a bin, and its standard error, from groups of modes around stratified ranks."""
    draws = np.random.default_rng(seed).random(SAMPLED_GROUPS)
    part = (np.arange(SAMPLED_GROUPS) + draws) / SAMPLED_GROUPS
    group = max(1, modes // SAMPLED_GROUPS)
    means = []
    for rank in start.n_below + (stop.n_below - start.n_below) * part:
        sigma, _ = shift_at_count(shift, start, stop, rank, tolerance=0.5 * group)
        found = slice_eigenpairs.nearest_eigenpairs(shift, sigma, group)
        inside = (found.values >= start.sigma) & (found.values < stop.sigma)
        if inside.any():
            weight = _weight(eigenproblem, found.vectors[:, inside])
            means.append(participation_ratio(weight).mean())
    if len(means) < 2:
        return means[0] if means else np.nan, np.inf
    # Two errors then hold as much of Student's t, which few groups follow, as of the normal law.
    scatter = np.std(means, ddof=1) / np.sqrt(len(means))
    return np.mean(means), 0.5 * stdtrit(len(means) - 1, TWO_SIGMA_QUANTILE) * scatter


def _mean(sums: BinSums, count: NDArray[np.int64]) -> NDArray[np.float64]:
    """Mean of every bin and its error, (2, B)."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(count > 0, np.array(sums) / count, np.nan)


def _named(name: str, mean: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    return {name: mean[0], f"{name}_error": mean[1]}
