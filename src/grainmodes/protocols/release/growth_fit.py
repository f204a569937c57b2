"""How fast a released mode grows and turns, from M(t) or A(t) alone: C (12), (13), (30), Fig. 6.

With a pair ω_r ± iω_i every coordinate follows e^(ω_i t) Re(c e^(−iω_r t)), and the mean of squares

    M(t) = a e^(2ω_i t) [1 + b cos(2ω_r t − φ)],   0 ≤ b ≤ 1.

C writes e^(2ω_i t) sin²(ω_r t + φ), which is b = 1: every grain moves on a straight line through
its place. Where grains move on spirals M does not come back to 0.

The fit is one of M e^(−2ω_i t) by least squares. It finds a and the two parts of the oscillation,
which enter linearly, for each (ω_i, ω_r). It starts from linear theory, with the records around the
densely recorded turns, many a turn, which distinguish ω_r from its aliases. The window of the fit
is then doubled until it holds all records, as a phase over a long time can be known only once the
frequency is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import OptimizeResult, least_squares

from grainmodes.linalg.failures import finite
from grainmodes.parameters.release import GROWTH_RANGE

MIN_RECORDS = 60
"""Records without which nothing is fitted."""


class GrowthFit(NamedTuple):
    """A fit of M(t) or A(t); all NaN where there were too few records.

    | symbol | name                                | unit     |
    | ------ | ----------------------------------- | -------- |
    | ω_i    | rate, with its standard error       | 1/t_0    |
    | ω_r    | frequency, with its standard error  | 1/t_0    |
    | a      | size                                | d² or 1  |
    | b      | depth                               | 1        |
    | φ      | phase                               | 1        |

    `misfit` is the root mean square deviation of the records in units of a e^(2ω_i t).
    """

    rate: float
    rate_error: float
    frequency: float
    frequency_error: float
    size: float
    depth: float
    phase: float
    misfit: float

    def mean(self, time: np.ndarray | float) -> np.ndarray:
        """a e^(2ω_i t): the fit without its oscillation, at times (R,) or at one time."""
        return self.size * np.exp(2.0 * self.rate * time)

    def at(self, time: np.ndarray) -> np.ndarray:
        """The fit at times (R,)."""
        oscillation = self.depth * np.cos(2.0 * self.frequency * time - self.phase)
        return self.mean(time) * (1.0 + oscillation)


NO_FIT = GrowthFit(*[np.nan] * len(GrowthFit._fields))
"""The fit of too few records."""


def in_growth_range(square: np.ndarray) -> np.ndarray:
    """Which records (R,) belong to the exponential growth, by their M; (R,) bool."""
    beyond = np.cumsum(square > GROWTH_RANGE[1]) > 0
    return (square > GROWTH_RANGE[0]) & ~beyond


def fit_growth(time: np.ndarray, square: np.ndarray, rate: float, frequency: float) -> GrowthFit:
    """Fit squares (R,) at times (R,), from the ω_i and ω_r of linear theory on."""
    if len(time) < MIN_RECORDS:
        return NO_FIT
    shift = time[_densest_record(time)]
    span, guess, near = 4.0 * np.pi / frequency, np.array([rate, frequency]), np.zeros(len(time))
    while not np.all(near):
        span *= 2.0
        near = np.abs(time - shift) <= span
        if near.sum() >= MIN_RECORDS:
            found = _fit_exponents(time[near] - shift, square[near], guess)
            guess = found.x
    return _growth_fit(found, time - shift, square, shift)


def _densest_record(time: np.ndarray) -> int:
    """Place of the record around which `MIN_RECORDS` records lie closest together."""
    spread = time[MIN_RECORDS - 1 :] - time[: len(time) - MIN_RECORDS + 1]
    return int(np.argmin(spread)) + MIN_RECORDS // 2


def _fit_exponents(time: np.ndarray, square: np.ndarray, start: np.ndarray) -> OptimizeResult:
    """ω_i and ω_r by least squares, each in units of what the span of times resolves."""
    flat, unit = square * np.exp(-2.0 * start[0] * time), 1.0 / np.ptp(time)
    flat = finite(flat / flat.mean())

    def residual(parameters: np.ndarray) -> np.ndarray:
        terms = _terms(time, parameters - [start[0], 0.0])
        difference: np.ndarray = terms @ np.linalg.lstsq(terms, flat, rcond=None)[0] - flat
        return difference

    return least_squares(residual, start, x_scale=unit, xtol=1e-15, ftol=1e-15, gtol=1e-15)


def _terms(time: np.ndarray, parameters: np.ndarray) -> np.ndarray:
    """e^(2ω_i t) times 1, cos 2ω_r t and sin 2ω_r t: (R, 3)."""
    rate, frequency = parameters
    turn = 2.0 * frequency * time
    oscillation = np.stack([np.ones(len(time)), np.cos(turn), np.sin(turn)], axis=1)
    terms: np.ndarray = np.exp(2.0 * rate * time)[:, None] * oscillation
    return terms


def _growth_fit(
    found: OptimizeResult, time: np.ndarray, square: np.ndarray, shift: float
) -> GrowthFit:
    """The fit with the exponents `found`, whose times were counted from `shift`."""
    rate, frequency = found.x
    flat = square * np.exp(-2.0 * rate * time)
    terms = _terms(time, np.array([0.0, frequency]))
    constant, cosine, sine = np.linalg.lstsq(terms, flat, rcond=None)[0]
    misfit = np.sqrt(np.mean((terms @ [constant, cosine, sine] - flat) ** 2))
    freedom = max(len(time) - 5, 1)
    variance = 2.0 * found.cost / freedom * np.linalg.inv(found.jac.T @ found.jac)
    rate_error, frequency_error = np.sqrt(np.diag(variance))
    phase = np.arctan2(sine, cosine) + 2.0 * frequency * shift
    return GrowthFit(
        rate=rate,
        rate_error=rate_error,
        frequency=frequency,
        frequency_error=frequency_error,
        size=constant * np.exp(-2.0 * rate * shift),
        depth=np.hypot(cosine, sine) / constant,
        phase=phase % (2.0 * np.pi),
        misfit=misfit / constant,
    )
