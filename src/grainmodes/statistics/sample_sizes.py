"""How many samples would settle a question that few samples leave open.

A question is settled by a p-value up to a level. Whether S samples reach it is a matter of chance:
the number named here is the smallest from which on they do in four of five cases, if the true
distribution is the measured one. With the number at which the measured value itself would reach the
level, every second try fails.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy import special

POWER = 0.8
"""Probability with which the named number of samples settles the question."""

MAX_SAMPLES = 10_000
"""Largest number of samples that is named; beyond it the number is ∞."""


def fewest_samples(settled: Callable[[np.ndarray], np.ndarray]) -> float:
    """The smallest number of samples from which on a question is settled; ∞ above `MAX_SAMPLES`.

    Args:
        settled: from numbers of samples (K,) >= 2 to whether so many settle the question, (K,)
        bool.
    """
    sizes = np.arange(2, MAX_SAMPLES + 1)
    (too_few,) = np.nonzero(~settled(sizes))
    if not len(too_few):
        return float(sizes[0])
    return float(sizes[too_few[-1]] + 1) if too_few[-1] + 1 < len(sizes) else np.inf


def mean_settles(sizes: np.ndarray, distance: float, level: float) -> np.ndarray:
    """Whether means of so many samples settle on which side of a limit the true mean lies.

    The distance of the mean from the limit, in its standard errors, must exceed the quantile of
    Student's t for the level by that for the power.

    Args:
        sizes: (K,) numbers of samples.
        distance: of the true mean from the limit, in standard deviations of a single sample.
    """
    quantiles = [special.stdtrit(sizes - 1.0, 1.0 - tail) for tail in (level, 1.0 - POWER)]
    return distance * np.sqrt(sizes) >= quantiles[0] + quantiles[1]


def share_settles(trials: np.ndarray, share: float, limit: float, level: float) -> np.ndarray:
    """Whether so many trials settle that a share is above a limit.

    Args:
        trials: (K,) numbers of independent trials.
        share: the true share, above the limit.
    """
    trials = np.floor(trials).astype(int)
    fewest = _fewest_having(np.maximum(trials, 1), limit, level)
    power = special.bdtrc(np.minimum(fewest - 1.0, trials), trials, share)
    return (fewest <= trials) & (power >= POWER)


def _fewest_having(trials: np.ndarray, limit: float, level: float) -> np.ndarray:
    """The smallest k with P(X >= k) <= level for X of so many trials with the probability limit.

    `bdtrik` inverts the distribution for real numbers, by iteration: a whole number may come out a
    little larger, and is then rounded up once too often.
    """
    most = np.ceil(special.bdtrik(1.0 - level, trials, limit))
    one_less = np.maximum(most - 1.0, 0.0)
    return np.where(special.bdtr(one_less, trials, limit) >= 1.0 - level, one_less, most) + 1.0
