"""Averages over samples, and averages over modes in bins of frequency.

Samples. The ensemble average of A, Eq. 17, runs over the S samples used; its uncertainty is the
standard error, (1/S) sum_s x_s ± [sum_s (x_s - mean)^2 / (S (S - 1))]^(1/2), unknown for S = 1.

Modes. omega_n = lambda_n^(1/2). The sums sum' leave out the zero modes: per sample the two
translations (the two smallest |lambda|, whatever their value: at k_T/k_N = 1e-8 rotations have
lambda t_0^2 ~ 1e-9, so that no absolute threshold separates them at every k_T) and the modes whose
eigenvalue equals zero within round-off (free rattlers, if these are kept). Negative eigenvalues
have no frequency. Zero and negative modes are both counted, so that none is lost. Per bin of width
w, from a to b,

    D(omega)     = <number of modes in the bin> / (3 N w)                            (A, Eq. 23)
    psi^R(omega) = <sum' psi_n^R over the bin> / <number of modes in the bin>        (A, Eq. 52)

    p(omega)     = <sum' p_n over the bin>      / <number of modes in the bin>       (A, Eq. E2)

so that the sum of D w over all bins is (modes counted) / (3 N). psi^T = 1 - psi^R (A, Eq. 51).
The error of D is the standard error over samples; psi and p are ratios of two averages r = A / C,
with the error of a ratio estimator: [S/(S - 1) sum_s (a_s - r c_s)^2]^(1/2) / sum_s c_s. Where a_s
is an estimate with an error e_s of its own, the scatter of the a_s contains it, but a few samples
may scatter less by chance: the error is then at least (sum_s e_s^2)^(1/2) / sum_s c_s.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.statistics.binning import BinSums

TRANSLATIONS = 2
"""Zero modes of every rigid sample under periodic boundaries."""

ZERO_MODE_RATIO = 1e-14
"""|lambda| / lambda_max below which a symmetric eigensolver cannot tell an eigenvalue from zero."""


class Average(NamedTuple):
    """A mean, its standard error, and the number of samples in it; arrays of one shape."""

    mean: np.ndarray
    standard_error: np.ndarray
    samples: np.ndarray


class Frequencies(NamedTuple):
    """omega_n (S, M) of the vibrations of S samples, and the numbers (S,) of all other modes."""

    frequency: np.ndarray
    zero: np.ndarray
    negative: np.ndarray


def average(values: np.ndarray, used: np.ndarray) -> Average:
    """Mean and standard error over the last axis.

    Args:
        values: (..., S) float; NaN stands for a value that does not exist and is left out.
        used: (..., S) bool, the samples to average over.

    Returns:
        arrays (...): mean, NaN without samples; standard error, NaN with fewer than two.
    """
    used = used & np.isfinite(values)
    samples = used.sum(axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(used, values, 0.0).sum(axis=-1) / samples
        deviation = np.where(used, values - mean[..., None], 0.0)
        variance_of_mean = (deviation**2).sum(axis=-1) / (samples * (samples - 1.0))
    return Average(mean, np.sqrt(np.where(samples > 1, variance_of_mean, np.nan)), samples)


def frequencies(eigenvalue: np.ndarray) -> Frequencies:
    """Frequencies of the vibrations among the eigenvalues of J.

    Args:
        eigenvalue: (S, M) float, k_N d^(1/2), any order, NaN where a sample has no such mode.

    Returns:
        frequency (S, M), 1/t_0, NaN where the mode is absent, zero or negative; counts (S,) of the
        zero and of the negative modes.
    """
    magnitude = np.abs(eigenvalue)
    present = np.isfinite(eigenvalue)
    rank = magnitude.argsort(axis=1).argsort(axis=1)
    zero_cutoff = ZERO_MODE_RATIO * np.where(present, magnitude, 0.0).max(axis=1, keepdims=True)
    zero = present & ((rank < TRANSLATIONS) | (magnitude <= zero_cutoff))
    negative = present & ~zero & (eigenvalue < 0.0)
    squared = np.where(present & ~zero & ~negative, eigenvalue, np.nan)
    return Frequencies(np.sqrt(squared), zero.sum(axis=1), negative.sum(axis=1))


def density_of_states(count: np.ndarray, n: int, edges: np.ndarray) -> Average:
    """D(omega) per bin (A, Eq. 23), averaged over samples; a sample without modes counts as 0.

    Args:
        count: (S, B) modes of each sample in each bin.
        n: number of grains, rattlers included.
        edges: (B + 1,) 1/t_0.

    Returns:
        arrays (B,), t_0; divided by 3 N also for frictionless grains, whose D is then comparable.
    """
    density = count / (3 * n * np.diff(edges))
    return average(density.T, np.ones(density.T.shape, dtype=bool))


def mode_average(count: np.ndarray, sums: BinSums) -> Average:
    """Mean of a number per mode in each bin, as psi of A, Eqs. 51-52.

    Args:
        count: (S, B) modes of each sample in each bin.
        sums: (S, B) the sums of the number over these modes; NaN leaves the sample out.

    Returns:
        arrays (B,): mean, NaN in an empty bin (A plots 0 there); error, NaN unless two samples
        have modes in the bin or errors are stated; number of samples with modes in the bin.
    """
    known = np.isfinite(sums.total) & (count > 0)
    count, total, stated = (np.where(known, values, 0.0) for values in (count, *sums))
    samples, size = known.sum(axis=0), np.isfinite(sums.total).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = total.sum(axis=0) / count.sum(axis=0)
        scatter = ((total - ratio * count) ** 2).sum(axis=0) * size / (size - 1.0)
        error = np.sqrt(np.where(samples > 1, scatter, np.nan)) / count.sum(axis=0)
        least = np.sqrt((stated**2).sum(axis=0)) / count.sum(axis=0)
    return Average(ratio, np.fmax(error, np.where(least > 0, least, np.nan)), samples)
