"""Claims of paper C on the growth of a released pair and its end: C4, C5, C10 to C12.

    symbol       name                                                       paper C
    ω_i, ω_r     release_rate_linear, release_frequency_linear              Eq. 12
    M, A         release_displacement_*, release_rotation_*: fits           Eq. 30, Fig. 6
    t_end        release_end_time: M leaves its fit                         Sec. VI B (3)

Numbers are taken from each run first; their mean and its error are those over the samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_c.released import RATE, Released, all_rates, released
from grainmodes.claims.part import MIN_SAMPLES, Part
from grainmodes.statistics.estimates import mean

if TYPE_CHECKING:
    import xarray as xr

TOLERANCE = 0.01
"""Relative difference to linear theory at which a fitted rate or frequency is equal to it."""

MIN_AXIS_RATIO = 0.1
"""Ratio of the axes of a grain's ellipse above which it is not a straight line."""

MAX_RATE_RATIO = 0.01
"""ω_i/ω_r up to which a growth is slow as in C (6e-5): M changes by less than 13 % in a turn, and
contacts do not change at the excursion of a single turn."""

LOG_END_RANGE = (-8.0, -6.0)
"""Range of log10 M that counts as "M ~ 1e-7"."""

MAX_DELAY = 2.0
"""Longest time, in 1/ω_i, between two events that count as simultaneous."""

MAX_DEATH_DELAY = 5.0
"""Longest time, in 1/ω_i, between the end of the growth and the death of the pair that counts as
one event on C's logarithmic axis, after a growth of some 17/ω_i. In the last turns of the growth
the pair comes and goes with every excursion."""

SQUARES = ("displacement", "rotation")
"""The prefixes of the fits of M and of A."""

MIN_DECADES = 1.5
"""Decades of ω_i that the states of a sample must span for an exponent of t_end."""

SLOPE_RANGE = (-1.1, -0.9)
"""Range of the exponent of t_end in ω_i that counts as −1."""

DOMINANCE_TOLERANCE = 0.05
"""Relative difference of the growth out of noise to the rate of the fastest pair: the next pair is
not yet negligible when M is fitted."""


@claim("C4", unit="1")
def spirals(ensemble: xr.Dataset) -> Outcome:
    """The grains of a growing complex pair move on spirals along its eigenvector (Fig. 5).

    The growth of every coordinate is fitted by e^(ω_i t) Re(z e^(-iω_r t)). The measured numbers
    are the part of the motion that the fit leaves, the overlap of z with the eigenvector, and the
    median ratio of the axes of the ellipse of a grain.

    Asked of: every listed growth rate with four released states.

    Criterion: The fit leaves less than 5 % of the motion, the overlap is above 0.99, and the median
    ratio of axes is above 0.1.
    """
    parts = []
    names = ("spiral_misfit", "spiral_overlap", "spiral_opening")
    for where, values in released(ensemble, *names):
        parts.append(Part(f"remaining motion, {where}", mean(values["spiral_misfit"]), high=0.05))
        parts.append(Part(f"overlap, {where}", mean(values["spiral_overlap"]), low=1.0 - TOLERANCE))
        parts.append(
            Part(f"ratio of axes, {where}", mean(values["spiral_opening"]), low=MIN_AXIS_RATIO)
        )
    return Outcome({"released states": parts})


@claim("C5", unit="1")
def growth(ensemble: xr.Dataset) -> Outcome:
    """M(t) and A(t) grow as e^(2ω_i t), oscillate with ω_r, and stop at M ~ 1e-7 (Figs. 6, 7).

    The numbers are taken from the run without damping, for every decade of ω_i: the relative
    differences of the fitted rates and frequencies of M and A to ω_i and ω_r; the time from the
    first change of contacts to the end of the growth, in 1/ω_i; and log10 of M at this end. The
    last one is judged for slow growth, ω_i < 0.01 ω_r, as in the paper: in a faster one M grows in
    a single turn by so much that the first contact changes earlier; the note has these numbers.

    Asked of: every listed growth rate with four released states; M at the end only where
    ω_i < 0.01 ω_r.

    Criterion: Rates and frequencies are within ±1 % of linear theory, the growth ends within ±2/ω_i
    of the first change of contacts, and log10 M at the end of a slow growth lies within -8 ... -6.
    """
    fits = [f"{square}_{name}" for square in SQUARES for name in ("rate", "frequency")]
    names = ("frequency_linear", "end_square", "end_time", "change_time", "displacement_depth")
    parts, notes = [], []
    for states in released(ensemble, *fits, *names):
        where, values = states
        for name in fits:
            linear = values[f"{name.rpartition('_')[2]}_linear"]
            difference = mean(values[name][:, 0] / linear - 1.0)
            part = f"{name.replace('_', ', ')}, {where}"
            parts.append(Part(part, difference, -TOLERANCE, TOLERANCE))
        delay = mean(_delay(states, "end_time", "change_time"))
        part = f"time from the change of contacts to the end of the growth, {where}"
        parts.append(Part(part, delay, -MAX_DELAY, MAX_DELAY))
        square = mean(np.log10(states.undamped("end_square")))
        if np.nanmedian(states.rate / values["frequency_linear"]) < MAX_RATE_RATIO:
            parts.append(Part(f"M at the end, {where}", square, *LOG_END_RANGE))
        depth = mean(states.undamped("displacement_depth"))
        notes.append(f"{where}: growth ends at log10 M = {square}, M oscillates by {depth}.")
    return Outcome({"released states": parts}, " ".join(notes))


def _delay(states: Released, later: str, earlier: str) -> np.ndarray:
    """Time between two events of the runs without damping, in 1/ω_i, (S,)."""
    return (states.undamped(later) - states.undamped(earlier)) * states.rate


@claim("C10", unit="1")
def end_of_growth(ensemble: xr.Dataset) -> Outcome:
    """The exponential growth ends at a time proportional to 1/ω_i (Sec. VI B (3), Fig. 7).

    This is the exponent of t_end in ω_i, fitted by least squares in logarithms to the states of
    each sample whose ω_i span at least 1.5 decades.

    Asked of: every point with samples whose released states span 1.5 decades of ω_i.

    Criterion: The exponent lies within -1.1 ... -0.9.
    """
    parts, notes = [], []
    for where, values in all_rates(ensemble, "end_time"):
        ends, rates = values["end_time"][:, :, 0], values[RATE]
        slopes = np.array([_exponent(*sample) for sample in zip(rates, ends, strict=True)])
        if not np.isfinite(slopes).any():
            continue
        parts.append(Part(where, mean(slopes), *SLOPE_RANGE))
        times, decades = np.log10(ends * rates), np.ptp(np.log10(rates[np.isfinite(ends)]))
        notes.append(
            f"At {where} log10(ω_i t_end) of {np.isfinite(times).sum()} states over {decades:.2g} "
            f"decades scatters by {np.nanstd(times):.2g}."
        )
    needed = "samples with released states whose growth rates span 1.5 decades"
    return Outcome({needed: parts}, " ".join(notes))


def _exponent(rates: np.ndarray, ends: np.ndarray) -> float:
    """The exponent of t_end (K,) in ω_i (K,) of one sample; NaN over less than `MIN_DECADES`."""
    known = np.isfinite(ends)
    if known.sum() < 2 or np.ptp(np.log10(rates[known])) < MIN_DECADES:
        return np.nan
    return float(np.polyfit(np.log10(rates[known]), np.log10(ends[known]), 1)[0])


@claim("C11", unit="1")
def death_of_the_pair(ensemble: xr.Dataset) -> Outcome:
    """The released pair dies when its growth ends (Sec. VI B (3), inset of Fig. 8).

    The pair is followed along the run without damping by its invariant subspace. The number is the
    time from the end of the growth to its death, the first of five states in a row in which it is
    not found, in 1/ω_i; the growth itself takes some 17/ω_i. The note counts the pairs that survive
    the run.

    Asked of: every listed growth rate with four released states.

    Criterion: The time lies within ±5/ω_i.
    """
    parts, notes = [], []
    for states in released(ensemble, "end_time", "death_time"):
        delay = (states.values["death_time"] - states.undamped("end_time")) * states.rate
        parts.append(Part(states.where, mean(delay), -MAX_DEATH_DELAY, MAX_DEATH_DELAY))
        ended = np.isfinite(states.undamped("end_time"))
        alive = ended & ~np.isfinite(states.values["death_time"])
        notes.append(f"{alive.sum()} of {ended.sum()} pairs survive at {states.where}.")
    return Outcome({"released states": parts}, " ".join(notes))


@claim("C12", unit="1")
def fastest_dominates(ensemble: xr.Dataset) -> Outcome:
    """Out of noise the mode with the largest ω_i dominates, whatever other pairs exist (Sec. VI B).

    A further run starts with random velocities of all grains instead of the mode of the pair. The
    numbers are the relative differences of the rate and the frequency fitted to its M to those of
    the fastest pair. Only states with at least two pairs are judged.

    Asked of: every listed growth rate with released states that have several pairs.

    Criterion: The differences are within ±5 %.
    """
    parts, notes = [], []
    names = ("noise_rate", "noise_frequency", "frequency_linear", "start_pairs")
    for where, values in released(ensemble, *names):
        several = values["start_pairs"] > 1
        if several.sum() < MIN_SAMPLES:
            continue
        for name in ("rate", "frequency"):
            difference = values[f"noise_{name}"] / values[f"{name}_linear"] - 1.0
            estimate = mean(np.where(several, difference, np.nan))
            part = f"{name}, {where}"
            parts.append(Part(part, estimate, -DOMINANCE_TOLERANCE, DOMINANCE_TOLERANCE))
        pairs = values["start_pairs"][several]
        notes.append(
            f"{where}: {several.sum()} states with {pairs.min():.0f} to {pairs.max():.0f} pairs."
        )
    return Outcome({"released states with more than one pair": parts}, " ".join(notes))
