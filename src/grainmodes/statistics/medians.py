"""Medians of samples, with the intervals of the sign test.

A sample lies above the true median with probability 1/2, whatever the distribution. The interval of
a median therefore ends at two of the sorted samples, and is exact. Single samples may be as far
away as they like. Six samples are the fewest that decide at 2 %. A bootstrap would give intervals
of the same quantity that are right for many samples only; it is not needed here.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import special

from grainmodes.statistics.measurement import STATED_PROBABILITY, with_interval
from grainmodes.statistics.shares import Share


class Median(NamedTuple):
    """The median of samples, sorted; infinite ones have a place in the order too."""

    ordered: tuple[float, ...]
    left_out: int = 0

    @property
    def samples(self) -> int:
        """Number of samples."""
        return len(self.ordered)

    @property
    def value(self) -> float:
        """The median, NaN without samples."""
        return float(np.median(self.ordered)) if self.ordered else np.nan

    def p_at_most(self, limit: float) -> float:
        """The p-value of "the true median is `limit` or less"; a sample at the limit is below."""
        return self._p_of(sum(value > limit for value in self.ordered))

    def p_at_least(self, limit: float) -> float:
        """The p-value of "the true median is `limit` or more"; a sample at the limit is above."""
        return self._p_of(sum(value < limit for value in self.ordered))

    def _p_of(self, beyond: int) -> float:
        return float(special.bdtrc(beyond - 1, self.samples, 0.5))

    def samples_above(self, limit: float, level: float) -> float:
        """As of a share: that of the samples above the limit must be above one half."""
        return self._samples_of(sum(value > limit for value in self.ordered), level)

    def samples_below(self, limit: float, level: float) -> float:
        """As of a share: that of the samples below the limit must be above one half."""
        return self._samples_of(sum(value < limit for value in self.ordered), level)

    def _samples_of(self, beyond: int, level: float) -> float:
        return Share(beyond, self.samples).samples_above(0.5, level)

    def interval(self, probability: float = STATED_PROBABILITY) -> tuple[float, float]:
        """From the k-th smallest sample to the k-th largest, infinite with too few samples."""
        tail = 0.5 * (1.0 - probability)
        ranks = range(1, self.samples // 2 + 1)
        narrow = [k for k in ranks if special.bdtr(k - 1, self.samples, 0.5) <= tail]
        if not narrow:
            return -np.inf, np.inf
        return self.ordered[narrow[-1] - 1], self.ordered[-narrow[-1]]

    def __str__(self) -> str:
        return f"median {with_interval(self, f'{self.value:.3g}')}"


def median(values: np.ndarray) -> Median:
    """The median of (S,) values; NaN are left out, and are not counted as such."""
    return Median(tuple(np.sort(values[~np.isnan(values)]).tolist()))
