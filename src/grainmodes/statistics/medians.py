"""Medians of samples, with the intervals of the sign test.

A sample lies above the true median with probability 1/2, whatever the distribution. The interval of
a median therefore ends at two of the sorted samples, and is exact. Single samples may be as far
away as they like: a modulus near jamming is negative in some packings and tiny in others, so that
means of its ratios are those of one sample. Six samples are the fewest that decide at 2 %.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import special

from grainmodes.statistics.measurement import STATED_PROBABILITY, with_interval


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


def median_relative_difference(values: np.ndarray, reference: np.ndarray) -> Median:
    """Median of (value - reference) / |reference| of (S,) each, paired by sample.

    A sample of which the reference is 0 has no ratio, and is counted in `left_out`.
    """
    known = np.isfinite(values) & np.isfinite(reference)
    used = known & (reference != 0.0)
    ratio = (values[used] - reference[used]) / np.abs(reference[used])
    return median(ratio)._replace(left_out=int((known & ~used).sum()))
