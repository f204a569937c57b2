"""Which states of a shear are released: C, Sec. VI.

Only a pair whose linear growth changes no contact in the range of M in which the growth is fitted
can be released (`linear_range`). A scene chooses

- the fastest of all such pairs of all states of the shear, or
- for every growth rate of a list the state whose fastest pair has the nearest rate, by its
  logarithm. The pair must be the fastest of its state, as that one dominates the dynamics of C, and
  its rate must lie within half a decade of the listed one.

C releases states with ω_i over several decades (Fig. 7), one of them with a single pair of
ω_i = 2.3e-5.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.parameters.release import GROWTH_RANGE
from grainmodes.protocols.pair_tracking.detection import PairState
from grainmodes.protocols.pair_tracking.linear_range import linear_ranges

MAX_DECADES = 0.5
"""Largest |log10| of the ratio of the growth rate of a state to the listed one."""


class ReleaseCandidate(NamedTuple):
    """A state to release, with ω_i of its pair, the place of this pair, and its linear range."""

    growth: float
    state: PairState
    place: int
    linear_range: float


class ReleaseCandidates:
    """The best candidates among the states seen so far.

    Args:
        rates: ω_i in 1/t_0, one candidate for each; without any one candidate, the fastest pair.

    Attributes:
        found: the candidates in the order of the rates; None where there is none.
    """

    def __init__(self, rates: tuple[float, ...] = ()):
        self._rates = rates
        self.found: list[ReleaseCandidate | None] = [None] * max(1, len(rates))

    def consider(self, state: PairState) -> None:
        """Take a state as a candidate where it is better than the one before."""
        if not self._rates:
            least = self.found[0].growth if self.found[0] else 0.0
            self.found[0] = fastest_candidate(state, least) or self.found[0]
            return
        growth = float(np.max(state.pairs.growth, initial=0.0))
        if not growth > 0.0:
            return
        nearer = [place for place in range(len(self._rates)) if self._is_nearer(place, growth)]
        candidate = candidate_of_fastest(state) if nearer else None
        if candidate:
            for place in nearer:
                self.found[place] = candidate

    def _is_nearer(self, place: int, growth: float) -> bool:
        """Whether a growth rate is nearer to the listed one than that of the candidate."""
        best, rate = self.found[place], self._rates[place]
        most = abs(np.log10(best.growth / rate)) if best else MAX_DECADES
        return bool(abs(np.log10(growth / rate)) < most)


def fastest_candidate(state: PairState, min_growth: float) -> ReleaseCandidate | None:
    """The fastest pair of a state with a sufficient linear range; None without one.

    Args:
        min_growth: ω_i in 1/t_0 that the pair must exceed.
    """
    growth = state.pairs.growth
    faster = np.flatnonzero(growth > min_growth)
    if not len(faster):
        return None
    ranges = linear_ranges(state.equilibrium, state.motions(faster))
    sufficient = ranges > GROWTH_RANGE[1]
    if not sufficient.any():
        return None
    best = int(np.argmax(np.where(sufficient, growth[faster], 0.0)))
    place = int(faster[best])
    return ReleaseCandidate(float(growth[place]), state, place, float(ranges[best]))


def candidate_of_fastest(state: PairState) -> ReleaseCandidate | None:
    """The fastest pair of a state; None where its linear range is not sufficient."""
    growth = state.pairs.growth
    place = int(np.argmax(growth))
    linear_range = float(linear_ranges(state.equilibrium, state.motions(np.array([place])))[0])
    if not linear_range > GROWTH_RANGE[1]:
        return None
    return ReleaseCandidate(float(growth[place]), state, place, linear_range)
