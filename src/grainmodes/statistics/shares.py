"""Shares of independent samples, with exact intervals.

Of n samples k have a property. The probability of this is binomial, so that the interval of Clopper
and Pearson needs no approximation: 4 of 4 is [0.40, 1] at 95 %, and not 1 without an error.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import special

from grainmodes.statistics.measurement import STATED_PROBABILITY


class Share(NamedTuple):
    """`having` of `samples` independent samples."""

    having: int
    samples: int
    left_out: int = 0

    @property
    def value(self) -> float:
        """having / samples, NaN without samples."""
        return self.having / self.samples if self.samples else np.nan

    def p_at_most(self, limit: float) -> float:
        """The p-value of "the true share is `limit` or less", 0 <= limit <= 1."""
        return float(special.bdtrc(self.having - 1, self.samples, limit))

    def p_at_least(self, limit: float) -> float:
        """The p-value of "the true share is `limit` or more", 0 <= limit <= 1."""
        return float(special.bdtr(self.having, self.samples, limit))

    def interval(self, probability: float = STATED_PROBABILITY) -> tuple[float, float]:
        """The interval of Clopper and Pearson."""
        tail, without = 0.5 * (1.0 - probability), self.samples - self.having
        low = special.betaincinv(self.having, without + 1, tail) if self.having else 0.0
        high = special.betaincinv(self.having + 1, without, 1.0 - tail) if without else 1.0
        return float(low), float(high)

    def __str__(self) -> str:
        low, high = self.interval()
        return f"{self.having} of {self.samples} [{low:.2f}, {high:.2f}]"


def share(flags: np.ndarray) -> Share:
    """The share of samples that have a property: (S,) of 1 and 0, NaN where it is not known."""
    known = flags[np.isfinite(flags)]
    return Share(int((known > 0).sum()), len(known))
