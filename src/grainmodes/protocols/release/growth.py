"""How fast a released mode grows and turns, from M(t) or A(t) alone: C (12), (13), (30), Fig. 6.

A pair ω_r ± iω_i makes every coordinate e^(ω_i t) Re(c e^(−iω_r t)), and the mean of squares

    M(t) = a e^(2ω_i t) [1 + depth cos(2ω_r t − φ)],   0 ≤ depth ≤ 1.

C writes e^(2ω_i t) sin²(ω_r t + φ), which is depth 1: every grain on a straight line through its
place. Where grains move on spirals M does not come back to 0.

Fitted is M e^(−2ω_i t), by least squares; a and the two parts of the oscillation are linear and
found for each (ω_i, ω_r). The fit starts from linear theory on the records nearest to the close
looks, many a turn, which tell ω_r from its aliases; its window is then doubled until it holds all
records asked for, as a phase over a long time is known only once the frequency is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

LINEAR = (1e-19, 1e-11)
"""M, in d², between which growth is fitted: above round-off, below what changes the forces."""

FEWEST = 60
"""Records without which nothing is fitted."""


class Law(NamedTuple):
    """A fitted law: ω_i and ω_r with standard errors, a, depth, φ.

    `misfit` is the root mean square deviation of the records in units of a e^(2ω_i t). All are NaN
    where there were too few records.
    """

    rate: float
    rate_error: float
    frequency: float
    frequency_error: float
    size: float
    depth: float
    phase: float
    misfit: float

    def mean(self, time: np.ndarray) -> np.ndarray:
        """a e^(2ω_i t): the law without its oscillation."""
        return self.size * np.exp(2.0 * self.rate * time)

    def at(self, time: np.ndarray) -> np.ndarray:
        """The law at times (R,)."""
        swing = self.depth * np.cos(2.0 * self.frequency * time - self.phase)
        return self.mean(time) * (1.0 + swing)


UNKNOWN = Law(*[np.nan] * len(Law._fields))


def fitted(time: np.ndarray, square: np.ndarray, rate: float, frequency: float) -> Law:
    """The law of squares (R,) at times (R,).

    Args:
        rate, frequency: of linear theory, where the fit starts.
    """
    if len(time) < FEWEST:
        return UNKNOWN
    shift = time[_closest(time)]
    span, guess, near = 4.0 * np.pi / frequency, np.array([rate, frequency]), np.zeros(len(time))
    while not np.all(near):
        span *= 2.0
        near = np.abs(time - shift) <= span
        if near.sum() >= FEWEST:
            found = _fit(time[near] - shift, square[near], guess)
            guess = found.x
    return _law(found, time - shift, square, shift)


def _closest(time: np.ndarray) -> int:
    """Where FEWEST records lie closest together: the middle one of them."""
    spread = time[FEWEST - 1 :] - time[: len(time) - FEWEST + 1]
    return int(np.argmin(spread)) + FEWEST // 2


def _fit(time: np.ndarray, square: np.ndarray, start: np.ndarray):
    """ω_i and ω_r by least squares, each in units of what the span of times resolves."""
    flat, unit = square * np.exp(-2.0 * start[0] * time), 1.0 / np.ptp(time)
    flat = flat / flat.mean()

    def residual(parameters: np.ndarray) -> np.ndarray:
        terms = _terms(time, parameters - [start[0], 0.0])
        return terms @ np.linalg.lstsq(terms, flat, rcond=None)[0] - flat

    return least_squares(residual, start, x_scale=unit, xtol=1e-15, ftol=1e-15, gtol=1e-15)


def _terms(time: np.ndarray, parameters: np.ndarray) -> np.ndarray:
    """e^(2ω_i t) times 1, cos 2ω_r t and sin 2ω_r t: (R, 3)."""
    rate, frequency = parameters
    turn = 2.0 * frequency * time
    return np.exp(2.0 * rate * time)[:, None] * np.stack(
        [np.ones(len(time)), np.cos(turn), np.sin(turn)], axis=1
    )


def _law(found, time: np.ndarray, square: np.ndarray, shift: float) -> Law:
    """The law of a fit whose clock runs from `shift`."""
    rate, frequency = found.x
    flat = square * np.exp(-2.0 * rate * time)
    terms = _terms(time, np.array([0.0, frequency]))
    a, b, c = np.linalg.lstsq(terms, flat, rcond=None)[0]
    misfit = np.sqrt(np.mean((terms @ [a, b, c] - flat) ** 2))
    freedom = max(len(time) - 5, 1)
    variance = 2.0 * found.cost / freedom * np.linalg.inv(found.jac.T @ found.jac)
    phase = np.arctan2(c, b) + 2.0 * frequency * shift
    errors = np.sqrt(np.diag(variance))
    size = a * np.exp(-2.0 * rate * shift)
    depth = np.hypot(b, c) / a
    return Law(
        rate, errors[0], frequency, errors[1], size, depth, phase % (2.0 * np.pi), misfit / a
    )
