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
skewness of 0.7 a wrong verdict still has a probability of at most 5 %.

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

MAX_REACH = 30.0
"""Half an interval over the distance to the limit, above which no number of samples is named."""


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
    """Parts of one verdict: contradicted ones most certain first, all others least certain."""
    if verdict == CONTRADICTED:
        return sorted(parts, key=lambda part: (part.p_true, part.margin))
    return sorted(
        parts,
        key=lambda part: (part.decidable, -np.nan_to_num(part.p_false, nan=1.0), part.margin),
    )


def needed_by(parts: list[Part], verdict: str) -> str:
    """What would decide a claim whose parts of this verdict are these, the deciding one first."""
    if verdict == NOT_COMPARABLE:
        return " and ".join(dict.fromkeys(part.needs for part in parts))
    return _samples_needed(parts[0]) if verdict == NOT_RESOLVED else ""


def _samples_needed(part: Part) -> str:
    """How many samples would decide, if the number stayed where it is and its interval shrank."""
    if not part.decidable:
        return f"{MIN_SAMPLES} samples at {part.where}"
    samples, (low, high) = part.measured.samples, part.measured.interval()
    reach, distance = 0.5 * (high - low), abs(part.margin)
    if not np.isfinite(reach) or reach >= MAX_REACH * distance:
        return f"more samples at {part.where}"
    needed = max(samples * (reach / distance) ** 2, samples + 1.0)
    return f"about {np.ceil(needed):.0f} samples at {part.where}"
