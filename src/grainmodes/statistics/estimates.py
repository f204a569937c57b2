"""Numbers with standard errors over samples, judged by Student's t.

`mean` is that of `grainmodes.statistics.averages`. What is not a mean, such as a ratio of two means
or the zero of a mean, takes its error from the jackknife: with theta_s the statistic without sample
s,

    error² = (S - 1) / S  sum_s (theta_s - mean theta)²,

which for a mean is its standard error. All arrays of one call are rows of the same S samples: where
two numbers come from the same packings, the scatter that they share drops out.

The error is itself measured, with S - 1 degrees of freedom, so that (value - true) / error follows
Student's t: chance alone takes a value three errors above the true one in 10 % of the cases at
S = 2, and in 1 % at S = 8. A number that takes two values only is not a mean but a share
(`shares.Share`).

S samples that agree exactly have the error 0, and tell nothing of the distribution but that all lie
on one side of a limit. They are judged by the sign test, p = 2^(-S), and not by an error that one
more sample may belie.

Differences relative to a number that may come close to 0 in single samples, such as a modulus near
jamming, have no useful mean: it is that of one sample. The mean of the logarithm of their size is
moved by one sample far less, and Student's t judges it with fewer samples than the sign test takes
to judge a median.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy import special

from grainmodes.statistics import averages
from grainmodes.statistics.measurement import STATED_PROBABILITY
from grainmodes.statistics.rounding import value_with_error
from grainmodes.statistics.sample_sizes import fewest_samples, mean_settles

ROUND_OFF = 1e-16
"""Relative difference below which two numbers are equal."""


class Estimate(NamedTuple):
    """A number and its standard error, NaN where fewer than two samples stand behind it.

    `freedom` is the number of degrees of freedom of the error, one less than the samples. As a text
    the number is rounded by its error: "0.49987(30)".
    """

    value: float
    error: float
    freedom: float
    left_out: int = 0

    @property
    def samples(self) -> float:
        """Number of samples that have the same degrees of freedom."""
        return self.freedom + 1.0

    def p_at_most(self, limit: float) -> float:
        """The p-value of "the true number is `limit` or less"."""
        return self._p_of(self.value - limit)

    def p_at_least(self, limit: float) -> float:
        """The p-value of "the true number is `limit` or more"."""
        return self._p_of(limit - self.value)

    def _p_of(self, beyond: float) -> float:
        """The p-value of a distance beyond a limit; of the sign test without an error."""
        if self.error == 0.0:
            return 0.5**self.samples if beyond > 0.0 else 1.0
        return float(special.stdtr(self.freedom, -beyond / self.error))

    def samples_above(self, limit: float, level: float) -> float:
        """Number of samples that would settle "the true number is above `limit`" at this level."""
        return self._samples_of(self.value - limit, level)

    def samples_below(self, limit: float, level: float) -> float:
        """Number of samples that would settle "the true number is below `limit`" at this level."""
        return self._samples_of(limit - self.value, level)

    def _samples_of(self, beyond: float, level: float) -> float:
        if not beyond > 0.0:
            return np.inf
        if self.error == 0.0:
            return np.ceil(-np.log2(level))
        distance = beyond / (self.error * np.sqrt(self.samples))
        return fewest_samples(lambda sizes: mean_settles(sizes, distance, level))

    def interval(self, probability: float = STATED_PROBABILITY) -> tuple[float, float]:
        """Value ± error times the quantile of Student's t."""
        reach = self.error * float(special.stdtrit(self.freedom, 0.5 + 0.5 * probability))
        return self.value - reach, self.value + reach

    def __str__(self) -> str:
        return value_with_error(self.value, self.error)


def complete(*rows: np.ndarray) -> np.ndarray:
    """The samples that have a number in every array: (S,) bool of arrays (S, ...)."""
    return np.all([np.isfinite(row).reshape(len(row), -1).all(axis=1) for row in rows], axis=0)


def mean(values: np.ndarray) -> Estimate:
    """Mean and standard error of (S,) values.

    NaN are left out, and so are infinite values, such as the logarithm of 0, which are counted.
    """
    average = averages.average(values, np.isfinite(values))
    infinite, freedom = int(np.isinf(values).sum()), int(average.samples) - 1
    return Estimate(float(average.mean), float(average.standard_error), freedom, infinite)


def difference_of_means(first: np.ndarray, second: np.ndarray) -> Estimate:
    """mean of second - mean of first, (S,) and (T,) values of samples that are not paired.

    The degrees of freedom are those of Welch and Satterthwaite.
    """
    one, other = mean(first), mean(second)
    squares = np.array([one.error**2, other.error**2])
    freedoms = np.array([one.freedom, other.freedom])
    with np.errstate(invalid="ignore", divide="ignore"):
        welch = squares.sum() ** 2 / (squares**2 / freedoms).sum()
    freedom = float(welch) if np.isfinite(welch) else float(freedoms.min())
    return Estimate(other.value - one.value, float(np.sqrt(squares.sum())), freedom)


def logarithm(values: np.ndarray) -> tuple[np.ndarray, int]:
    """The natural logarithm of an array, NaN where a number is not positive, and how many are not.

    NaN among the values are not counted.
    """
    positive = values > 0.0
    logarithms = np.log(np.where(positive, values, np.nan))
    return logarithms, int((np.isfinite(values) & ~positive).sum())


def jackknife(statistic: Callable[..., float], *rows: np.ndarray) -> Estimate:
    """A smooth function of arrays (S, ...), over the samples that are complete in all of them.

    NaN with the error NaN where fewer than two samples are.
    """
    used = complete(*rows)
    rows = tuple(row[used] for row in rows)
    size = int(used.sum())
    if size < 2:
        return Estimate(np.nan, np.nan, size - 1)
    without = np.array([statistic(*(np.delete(row, s, 0) for row in rows)) for s in range(size)])
    error = np.sqrt((size - 1) * np.mean((without - without.mean()) ** 2))
    return Estimate(float(statistic(*rows)), float(error), size - 1)


def relative_difference(values: np.ndarray, reference: np.ndarray) -> Estimate:
    """(mean of values - mean of reference) / mean of reference, (S,) each, paired by sample."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return jackknife(lambda a, b: (a - b).mean() / b.mean(), values, reference)


def log_relative_difference(values: np.ndarray, reference: np.ndarray) -> Estimate:
    """Mean of log10(|value - reference| / |reference|), (S,) each, paired by sample.

    Differences below `ROUND_OFF` count as this, and those above 1 as 1: two numbers that have
    nothing in common do not differ the more for a small reference. Where the reference is 0 there
    is no ratio; such samples are counted in `left_out`.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.abs(values - reference) / np.abs(reference)
    exists = reference != 0.0
    size = np.where(exists, np.clip(ratio, ROUND_OFF, 1.0), np.inf)
    return mean(np.where(np.isnan(ratio) & exists, np.nan, np.log10(size)))


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
