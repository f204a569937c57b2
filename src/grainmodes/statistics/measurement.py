"""What a measured number must answer, however it was estimated.

A claim gives a limit, and asks how probable a number as far beyond it as the measured one would be
if the true number were at the limit: the p-value of a one-sided test. A mean answers by Student's t
(`estimates.Estimate`), a share by the binomial distribution (`shares.Share`), a median by the sign
test (`medians.Median`).
"""

from __future__ import annotations

from typing import Protocol

STATED_PROBABILITY = 0.95
"""Probability of the intervals that are printed."""


class Measurement(Protocol):
    """A number with its statistical uncertainty; as a text it is rounded by it."""

    @property
    def value(self) -> float:
        """The number; NaN if there is none."""

    @property
    def samples(self) -> float:
        """Number of independent samples behind it."""

    @property
    def left_out(self) -> int:
        """Number of samples that have no such number, because a logarithm or a ratio fails."""

    def p_at_most(self, limit: float) -> float:
        """The p-value of "the true number is `limit` or less"."""

    def p_at_least(self, limit: float) -> float:
        """The p-value of "the true number is `limit` or more"."""

    def samples_above(self, limit: float, level: float) -> float:
        """Number of samples that would settle "the true number is above `limit`" at this level.

        It is that of `sample_sizes.fewest_samples`; ∞ where the measured number is not above.
        """

    def samples_below(self, limit: float, level: float) -> float:
        """The same for "the true number is below `limit`"."""

    def interval(self, probability: float = STATED_PROBABILITY) -> tuple[float, float]:
        """The ends of the two-sided interval of this probability."""


def with_interval(number: Measurement, value: str) -> str:
    """A number as text with its interval behind it: "0.50 [0.16, 0.84]"."""
    low, high = number.interval()
    return f"{value} [{low:.3g}, {high:.3g}]"
