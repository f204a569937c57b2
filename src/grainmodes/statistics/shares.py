"""Shares, with intervals of the binomial distribution.

**Of independent samples** k of n have a property (`Share`). The interval of Clopper and Pearson
needs no approximation: 4 of 4 is [0.40, 1] at 95 %, and not 1 without an error.

**Of events in samples** (`PooledShare`). The events of one sample are not independent, and samples
have different numbers of them. A mean of the shares of the samples has the error 0 if all events
agree, however few they are. Here the events of all samples are counted together, as Korn and
Graubard do it (Survey Methodology 24, 193, 1998): with k_s of the n_s events of sample s, n = sum_s
n_s and the share r = sum_s k_s / n, the interval is that of Clopper and Pearson for

    n* = n / max(1, e) (z / t)²,     e = S/(S - 1) sum_s (k_s - r n_s)² / [n r (1 - r)],

independent events, of which r n* have the property. The design effect e compares the scatter of the
samples with that of independent events; where all events agree, it is 1. z and t are the quantiles
of the normal distribution and of Student's with S - 1 degrees of freedom for the tail of the
interval: few samples know their scatter badly. So 80 events of four samples that agree count as 30
at 95 %, and agreement does not count as certainty. The p-value of a limit is the tail of the
interval that ends there.

This holds as long as the events of a sample depend on each other weakly, with a correlation up to
about 0.1: at a stronger one, samples may agree by chance and hide it. Where a property lives
through all states of a sample, samples are counted (`Share`). With one trial for each sample, 38
that agree are needed to be above a share of 0.9 with a p-value of 0.02; no study has so many.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from scipy import special
from scipy.optimize import brentq

from grainmodes.statistics.measurement import STATED_PROBABILITY
from grainmodes.statistics.sample_sizes import fewest_samples, share_settles

TAILS = (1e-12, 0.499)
"""Smallest and largest tail of an interval, and so of a p-value other than 1."""


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
        return _p_at_most(self.having, self.samples, limit)

    def p_at_least(self, limit: float) -> float:
        """The p-value of "the true share is `limit` or more", 0 <= limit <= 1."""
        return _p_at_most(self.samples - self.having, self.samples, 1.0 - limit)

    def samples_above(self, limit: float, level: float) -> float:
        """Number of samples that would settle "the true share is above `limit`" at this level."""
        if not self.value > limit:
            return np.inf
        return fewest_samples(lambda sizes: share_settles(sizes, self.value, limit, level))

    def samples_below(self, limit: float, level: float) -> float:
        """Number of samples that would settle "the true share is below `limit`" at this level."""
        return self._without().samples_above(1.0 - limit, level)

    def _without(self) -> Share:
        return Share(self.samples - self.having, self.samples)

    def interval(self, probability: float = STATED_PROBABILITY) -> tuple[float, float]:
        """The interval of Clopper and Pearson."""
        return _interval(self.having, self.samples, probability)

    def __str__(self) -> str:
        low, high = self.interval()
        return f"{self.having} of {self.samples} [{low:.2f}, {high:.2f}]"


class PooledShare(NamedTuple):
    """`having` of the `events` of `samples` samples, with the `design_effect` of these."""

    having: int
    events: int
    samples: int
    design_effect: float = 1.0
    left_out: int = 0

    @property
    def value(self) -> float:
        """having / events, NaN without events."""
        return self.having / self.events if self.events else np.nan

    def independent_events(self, samples: np.ndarray | float, tail: float) -> np.ndarray:
        """n* of so many samples (K,) with as many events each as those measured."""
        of_sample = self.events / self.samples / self.design_effect
        student = special.stdtrit(np.asarray(samples) - 1.0, tail)
        return samples * of_sample * (special.ndtri(tail) / student) ** 2

    def p_at_most(self, limit: float) -> float:
        """The p-value of "the true share is `limit` or less", 0 <= limit <= 1."""
        if self.samples < 2:
            return np.nan
        lowest, highest = TAILS
        if self._beyond(lowest, limit) <= 0.0:
            return lowest
        if self._beyond(highest, limit) >= 0.0:
            return 1.0
        return float(brentq(self._beyond, lowest, highest, args=(limit,), xtol=1e-14))

    def _beyond(self, tail: float, limit: float) -> float:
        """Above 0 where the lower end of the interval with this tail lies below the limit."""
        trials = float(self.independent_events(self.samples, tail))
        return _p_at_most(self.value * trials, trials, limit) - tail

    def p_at_least(self, limit: float) -> float:
        """The p-value of "the true share is `limit` or more", 0 <= limit <= 1."""
        return self._without().p_at_most(1.0 - limit)

    def samples_above(self, limit: float, level: float) -> float:
        """Number of samples that would settle "the true share is above `limit`" at this level.

        The design effect of independent events scatters by [2/(S - 1)]^(1/2) about 1. Only values
        above 1 count, so that its mean is 1 + [1/(π(S - 1))]^(1/2).
        """
        if not self.value > limit:
            return np.inf

        def settled(sizes: np.ndarray) -> np.ndarray:
            by_chance = 1.0 + np.sqrt(1.0 / (np.pi * (sizes - 1.0)))
            effect = np.maximum(by_chance / self.design_effect, 1.0)
            trials = self.independent_events(sizes, level) / effect
            return share_settles(trials, self.value, limit, level)

        return fewest_samples(settled)

    def samples_below(self, limit: float, level: float) -> float:
        """Number of samples that would settle "the true share is below `limit`" at this level."""
        return self._without().samples_above(1.0 - limit, level)

    def _without(self) -> PooledShare:
        return self._replace(having=self.events - self.having)

    def interval(self, probability: float = STATED_PROBABILITY) -> tuple[float, float]:
        """The interval of Korn and Graubard."""
        if self.samples < 2:
            return 0.0, 1.0
        trials = float(self.independent_events(self.samples, 0.5 * (1.0 - probability)))
        return _interval(self.value * trials, trials, probability)

    def __str__(self) -> str:
        low, high = self.interval()
        events = f"{self.having} of {self.events} events in {self.samples} samples"
        return f"{events} [{low:.2f}, {high:.2f}]"


def _p_at_most(having: float, trials: float, limit: float) -> float:
    """P(X >= having) for X of so many trials with the probability limit; real numbers of both."""
    if having <= 0.0:
        return 1.0
    return float(special.betainc(having, trials - having + 1.0, limit))


def _interval(having: float, trials: float, probability: float) -> tuple[float, float]:
    """The interval of Clopper and Pearson; real numbers of both."""
    if not trials > 0.0:
        return 0.0, 1.0
    tail, without = 0.5 * (1.0 - probability), trials - having
    low = special.betaincinv(having, without + 1.0, tail) if having > 0.0 else 0.0
    high = special.betaincinv(having + 1.0, without, 1.0 - tail) if without > 0.0 else 1.0
    return float(low), float(high)


def share(flags: np.ndarray) -> Share:
    """The share of samples that have a property: (S,) of 1 and 0, NaN where it is not known."""
    known = flags[np.isfinite(flags)]
    return Share(int((known > 0).sum()), len(known))


def pooled_share(flags: Iterable[np.ndarray]) -> PooledShare:
    """The share of events that have a property: of every sample (E,) of 1 and 0, NaN for none.

    Samples without an event are no samples of it.
    """
    known = [row[np.isfinite(row)] > 0 for row in flags]
    counts = np.array([(row.sum(), len(row)) for row in known if len(row)]).reshape(-1, 2)
    having, events = counts.sum(axis=0).tolist()
    of_all = having / events if events else np.nan
    independent = events * of_all * (1.0 - of_all)
    effect = 1.0
    if len(counts) > 1 and independent > 0.0:
        scatter = ((counts[:, 0] - of_all * counts[:, 1]) ** 2).sum()
        effect = max(1.0, len(counts) / (len(counts) - 1) * scatter / independent)
    return PooledShare(having, events, len(counts), effect)
