"""One number of a claim, and how it is judged beside the others.

A part is a number with the interval in which the claim expects it, or outside which. Two one-sided
tests judge it (`statistics.measurement`):

    holds          "it lies where the claim does not expect it" has p <= 0.02
    contradicted   "it lies where the claim expects it" has p <= 0.005, after Holm's correction
                   for all parts of the claim
    not resolved   neither, or fewer than four samples

A claim that holds needs every part, so that no correction is due: the part that is least sure
decides. A claim is contradicted by one part, and the more parts it has, the more of them lie far
away by chance: hence Holm. The levels are low, because samples are not quite normal: with a
skewness of 0.7 a wrong verdict still has a probability of at most 5 %. A share and a median of few
samples cannot reach the second level, however far away the samples lie: the fewer samples, and the
more parts, the less. A claim that is asked of many parts is therefore measured by means where the
quantity has one.

A part that names what makes it comparable (`needs`) is not judged: the number is shown, and what
the claim speaks of cannot be seen in it, such as the gap between two bands in a box whose lowest
sound wave lies inside the gap.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.statistics.measurement import Measurement
from grainmodes.statistics.multiple_tests import holm

HOLDS = "holds"
CONTRADICTED = "contradicted"
NOT_RESOLVED = "not resolved at this size"
NOT_COMPARABLE = "not comparable at this size"

HOLD_LEVEL = 0.02
"""Largest probability that a part which is false holds by chance."""

CONTRADICT_LEVEL = 0.005
"""Largest probability that a claim which is true is contradicted by chance."""

MIN_SAMPLES = 4
"""Smallest number of samples behind a verdict."""


class Part(NamedTuple):
    """One number of a claim: where it was measured, and the interval in which it is expected.

    `outside`: the claim expects it outside the interval. `needs`: what would make the number
    comparable with that of the claim, such as "N ≥ 4096"; empty if it is.
    """

    where: str
    measured: Measurement
    low: float = -np.inf
    high: float = np.inf
    outside: bool = False
    needs: str = ""

    @property
    def decidable(self) -> bool:
        """Whether the number exists, is comparable, and has enough samples behind it."""
        value = self.measured.value
        known = not (np.isnan(value) or np.isnan(self.measured.p_at_most(value)))
        return known and self.measured.samples >= MIN_SAMPLES and not self.needs

    @property
    def without_scatter(self) -> bool:
        """Whether all samples agree, so that the interval has no width."""
        low, high = self.measured.interval()
        return low == high

    @property
    def p_false(self) -> float:
        """The p-value of "the number lies where the claim does not expect it"."""
        return self._p_inside() if self.outside else self._p_outside()

    @property
    def p_true(self) -> float:
        """The p-value of "the number lies where the claim expects it"."""
        return self._p_outside() if self.outside else self._p_inside()

    def _p_outside(self) -> float:
        below = self.measured.p_at_most(self.low) if np.isfinite(self.low) else 0.0
        above = self.measured.p_at_least(self.high) if np.isfinite(self.high) else 0.0
        return max(below, above)

    def _p_inside(self) -> float:
        """Each end of the interval is one test."""
        tests = []
        if np.isfinite(self.low):
            tests.append(self.measured.p_at_least(self.low))
        if np.isfinite(self.high):
            tests.append(self.measured.p_at_most(self.high))
        return min(1.0, len(tests) * min(tests, default=1.0))

    def samples_needed(self, judged: int) -> float:
        """Number of samples that would settle where the number lies, if it stayed where it is.

        Where it is expected, this is a number that lets the claim hold, else one that contradicts
        it as one of `judged` parts; ∞ where no number of samples is named.
        """
        if np.isnan(self.measured.p_at_most(self.measured.value)):
            return MIN_SAMPLES
        expected = self.margin > 0.0
        level = HOLD_LEVEL if expected else CONTRADICT_LEVEL / max(judged, 1)
        needed = self._samples_inside(level) if expected != self.outside else self._beyond(level)
        return max(needed, MIN_SAMPLES, self.measured.samples + 1 if self.decidable else 0)

    def _samples_inside(self, level: float) -> float:
        """Both ends of the interval must be settled."""
        above_low = self.measured.samples_above(self.low, level) if np.isfinite(self.low) else 0.0
        below_high = (
            self.measured.samples_below(self.high, level) if np.isfinite(self.high) else 0.0
        )
        return max(above_low, below_high)

    def _beyond(self, level: float) -> float:
        """The end that the number lies beyond must be settled; each end is one test."""
        level /= np.isfinite([self.low, self.high]).sum()
        if self.measured.value < self.low:
            return self.measured.samples_below(self.low, level)
        return self.measured.samples_above(self.high, level)

    @property
    def margin(self) -> float:
        """Distance from the nearer end of the interval; negative where it is not expected."""
        distance = min(self.measured.value - self.low, self.high - self.measured.value)
        return -distance if self.outside else distance

    @property
    def printed(self) -> str:
        """The number, and the samples that have none."""
        without = self.measured.left_out
        samples = "sample" if without == 1 else "samples"
        return f"{self.measured}" + f" ({without} {samples} without a number)" * (without > 0)


def verdicts_of(parts: list[Part]) -> list[str]:
    """The verdict of each part of one claim."""
    corrected = iter(holm(np.array([part.p_true for part in parts if part.decidable])))
    return [_verdict(part, next(corrected) if part.decidable else 1.0) for part in parts]


def _verdict(part: Part, corrected: float) -> str:
    if part.needs:
        return NOT_COMPARABLE
    if corrected <= CONTRADICT_LEVEL:
        return CONTRADICTED
    return HOLDS if part.decidable and part.p_false <= HOLD_LEVEL else NOT_RESOLVED


def by_certainty(parts: list[Part], verdict: str) -> list[Part]:
    """Parts of one verdict: contradicted ones most certain first, all others least certain.

    Of numbers without any scatter, such as a difference of 0 in all samples, only a bound of the
    p-value is known: they come last.
    """
    if verdict == CONTRADICTED:
        return sorted(parts, key=lambda part: (part.p_true, part.margin))
    return sorted(
        parts,
        key=lambda part: (
            part.decidable,
            part.without_scatter,
            -np.nan_to_num(part.p_false, nan=1.0),
            part.margin,
        ),
    )


def needed_by(parts: list[Part], verdict: str, judged: int) -> str:
    """What would decide a claim whose parts of this verdict are these.

    Of parts that are not resolved it is the one that takes most samples.

    Args:
        judged: number of parts of the claim that are judged, for Holm's correction.
    """
    if verdict == NOT_COMPARABLE:
        return " and ".join(dict.fromkeys(part.needs for part in parts))
    if verdict != NOT_RESOLVED:
        return ""
    needed = [part.samples_needed(judged) for part in parts]
    most = max(needed)
    number = f"about {most:.0f}" if np.isfinite(most) else "more"
    return f"{number} samples at {parts[needed.index(most)].where}"
