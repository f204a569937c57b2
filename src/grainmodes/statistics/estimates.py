"""Numbers with standard errors over samples.

`mean` is that of `grainmodes.statistics.averages`. What is not a mean, such as a ratio of two means
or the zero of a mean, takes its error from the jackknife: with theta_s the statistic without sample
s,

    error² = (S - 1) / S  sum_s (theta_s - mean theta)²,

which for a mean is its standard error. All arrays of one call are rows of the same S samples: where
two numbers come from the same packings, the scatter that they share drops out.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from grainmodes.statistics import averages
from grainmodes.statistics.rounding import value_with_error


class Estimate(NamedTuple):
    """A number and its standard error, NaN where fewer than two samples stand behind it.

    As a text it is rounded by its error: "0.49987(30)".
    """

    value: float
    error: float

    def __str__(self) -> str:
        return value_with_error(self.value, self.error)


def complete(*rows: np.ndarray) -> np.ndarray:
    """The samples that have a number in every array: (S,) bool of arrays (S, ...)."""
    return np.all([np.isfinite(row).reshape(len(row), -1).all(axis=1) for row in rows], axis=0)


def mean(values: np.ndarray) -> Estimate:
    """Mean and standard error of (S,) values; NaN are left out."""
    average = averages.average(values, np.isfinite(values))
    return Estimate(float(average.mean), float(average.standard_error))


def jackknife(statistic: Callable[..., float], *rows: np.ndarray) -> Estimate:
    """A smooth function of arrays (S, ...), over the samples that are complete in all of them.

    NaN with the error NaN where fewer than two samples are.
    """
    used = complete(*rows)
    rows = tuple(row[used] for row in rows)
    size = int(used.sum())
    if size < 2:
        return Estimate(np.nan, np.nan)
    without = np.array([statistic(*(np.delete(row, s, 0) for row in rows)) for s in range(size)])
    error = np.sqrt((size - 1) * np.mean((without - without.mean()) ** 2))
    return Estimate(float(statistic(*rows)), float(error))


def relative_difference(values: np.ndarray, reference: np.ndarray) -> Estimate:
    """(mean of values - mean of reference) / mean of reference, (S,) each, paired by sample."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return jackknife(lambda a, b: (a - b).mean() / b.mean(), values, reference)


def crossing(x: np.ndarray, rows: np.ndarray) -> Estimate:
    """The x at which the mean of rows (S, K) rises through 0, linear in log x between the points.

    Args:
        x: (K,) ascending, positive.

    Returns:
        the last x where the mean never rises through 0 and ends negative, else the first: the zero
        then lies beyond the points.
    """
    logarithm = np.log(x)

    def zero(samples: np.ndarray) -> float:
        values = samples.mean(axis=0)
        (rises,) = np.nonzero((values[:-1] < 0) & (values[1:] >= 0))
        if not rises.size:
            return x[-1] if values[-1] < 0 else x[0]
        below, above = rises[0], rises[0] + 1
        part = values[below] / (values[below] - values[above])
        return float(np.exp(logarithm[below] + part * (logarithm[above] - logarithm[below])))

    return jackknife(zero, rows)
