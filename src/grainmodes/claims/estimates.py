"""Numbers with standard errors over seeds.

`mean` is that of `grainmodes.statistics.averages`. What is no mean, as a ratio of two means or the
zero of a mean, takes its error from the jackknife: with theta_s the statistic without sample s,

    error² = (S - 1) / S  sum_s (theta_s - mean theta)²,

which for a mean is its standard error. All arrays of one call are rows of the same seeds: where two
numbers come from the same packings, what the packings have in common drops out.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from grainmodes.statistics import averages


class Estimate(NamedTuple):
    """A number and its standard error, NaN where fewer than two samples stand behind it."""

    value: float
    error: float


def complete(*rows: np.ndarray) -> np.ndarray:
    """The samples that have a number in every array: (S,) bool of arrays (S, ...)."""
    return np.all([np.isfinite(row).reshape(len(row), -1).all(axis=1) for row in rows], axis=0)


def mean(values: np.ndarray) -> Estimate:
    """Mean of (S,) values; NaN are left out."""
    found = averages.average(values, np.isfinite(values))
    return Estimate(float(found.mean), float(found.standard_error))


def jackknife(statistic: Callable[..., float], *rows: np.ndarray) -> Estimate:
    """A smooth function of arrays (S, ...), over the samples that are complete in all of them."""
    used = complete(*rows)
    rows = tuple(row[used] for row in rows)
    size = int(used.sum())
    if size < 2:
        return Estimate(np.nan, np.nan)
    without = np.array([statistic(*(np.delete(row, s, 0) for row in rows)) for s in range(size)])
    error = np.sqrt((size - 1) * np.mean((without - without.mean()) ** 2))
    return Estimate(float(statistic(*rows)), float(error))


def relative_difference(values: np.ndarray, reference: np.ndarray) -> Estimate:
    """(mean of values - mean of reference) / mean of reference, paired by seed."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return jackknife(lambda a, b: (a - b).mean() / b.mean(), values, reference)


def crossing(kappas: np.ndarray, rows: np.ndarray) -> Estimate:
    """k_T/k_N at which the mean of rows (S, K) rises through 0, linear in log(k_T/k_N) between.

    Args:
        kappas: (K,) ascending, positive.

    Returns:
        the last of `kappas` where it never does and ends negative, else the first: the zero lies
        beyond.
    """
    logarithm = np.log(kappas)

    def zero(samples: np.ndarray) -> float:
        values = samples.mean(axis=0)
        (rises,) = np.nonzero((values[:-1] < 0) & (values[1:] >= 0))
        if not rises.size:
            return kappas[-1] if values[-1] < 0 else kappas[0]
        below, above = rises[0], rises[0] + 1
        share = values[below] / (values[below] - values[above])
        return float(np.exp(logarithm[below] + share * (logarithm[above] - logarithm[below])))

    return jackknife(zero, rows)
