"""The outcome of a release, from its records: C, Sec. VI A and B, Figs. 5 to 7.

| stage of C, Sec. VI B      | how it is found here                                               |
| -------------------------- | ------------------------------------------------------------------ |
| exponential growth         | M between 1e-19 and 1e-11 d², where M and A are fitted             |
| end of the growth          | the first record whose M differs from the fit by half of its mean  |
| change of contacts         | the first record whose contacts are not those of the start         |
| plateau                    | from the end of the growth to the second instability               |
| second instability         | the first record with M above ⟨ξ⟩², the mean overlap squared       |
| diffusive regime           | x in M − M_2 ∝ (t − t_2)^x over the last decade of t − t_2, from   |
|                            | the second instability (t_2, M_2) on: 1 is diffusion               |
| final state                | means over the last tenth of the run                               |

The onset of a stage that did not happen has a time and an M of NaN.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from grainmodes.parameters.release import GROWTH_RANGE
from grainmodes.protocols.release.growth_fit import NO_FIT, GrowthFit, fit_growth, in_growth_range
from grainmodes.protocols.release.record import MotionRecord
from grainmodes.protocols.release.release_run import ReleaseRun

MAX_FIT_DEVIATION = 0.5
"""Deviation of M from its fit, relative to the mean of the fit, up to which M still grows."""

SLIDING_DELAY = 2.0
"""Time after the end of the growth, in 1/ω_i, in which sliding contacts still belong to it."""

DIFFUSION_BINS = 8
"""Logarithmic intervals of time over which M is averaged before its exponent is fitted."""

FINAL_PART = 0.1
"""Part of a run, at its end, over which the final state is averaged."""


class Onset(NamedTuple):
    """The time at which a stage begins, and M at that time in d²."""

    time: float
    square: float


NO_ONSET = Onset(np.nan, np.nan)
"""The onset of a stage that did not happen."""


class ReleaseOutcome(NamedTuple):
    """The fits of M and A, the onsets of the later stages, the largest M, and the final state.

    `end` is the end of the growth, `change` the first change of contacts, `second` the second
    instability, `growth_sliding` the largest number of sliding contacts until 2/ω_i after the end
    of the growth, and `after` holds the means of all records of the final state.
    """

    displacement: GrowthFit
    rotation: GrowthFit
    end: Onset
    change: Onset
    second: Onset
    largest: float
    growth_sliding: float
    diffusion_exponent: float
    after: MotionRecord


def release_outcome(run: ReleaseRun, rate: float) -> ReleaseOutcome:
    """The outcome of a run that is done, whose pair grows at `rate`, in 1/t_0, in linear theory."""
    series = record_series(run.records)
    square, time = series["mean_square_displacement"], series["time"]
    displacement, rotation = (
        _growth_fit(run, series, name, rate)
        for name in ("mean_square_displacement", "mean_square_rotation")
    )
    overlap = run.start.packing.contacts.overlap.mean()
    final = time >= (1.0 - FINAL_PART) * time[-1]
    end = _end_of_growth(time, square, displacement)
    second = _first_onset(time, square, square > overlap**2)
    return ReleaseOutcome(
        displacement,
        rotation,
        end,
        _first_onset(time, square, series["changed"] > 0),
        second,
        float(square.max()),
        _sliding_until(end.time + SLIDING_DELAY / run.start.growth_rate, time, series["sliding"]),
        _diffusion_exponent(time, square, second),
        MotionRecord(*(float(values[final].mean()) for values in series.values())),
    )


def record_series(records: list[MotionRecord]) -> dict[str, np.ndarray]:
    """Every quantity of the records by its name, (R,)."""
    return dict(zip(MotionRecord._fields, np.array(records, float).T, strict=True))


def _growth_fit(
    run: ReleaseRun, series: Mapping[str, np.ndarray], name: str, rate: float
) -> GrowthFit:
    """The fit of M or A, if M grew through the whole range in which it is fitted."""
    square = series["mean_square_displacement"]
    if not (square > GROWTH_RANGE[1]).any():
        return NO_FIT
    used = in_growth_range(square)
    return fit_growth(
        series["time"][used], series[name][used], np.nan_to_num(rate), run.start.frequency
    )


def _end_of_growth(time: np.ndarray, square: np.ndarray, fit: GrowthFit) -> Onset:
    """When M leaves its fit, with the M of the fit."""
    if not np.isfinite(fit.rate):
        return NO_ONSET
    later = time >= time[in_growth_range(square)][-1]
    with np.errstate(over="ignore"):
        deviates = np.abs(square - fit.at(time)) > MAX_FIT_DEVIATION * fit.mean(time)
    left = later & deviates
    if not left.any():
        return NO_ONSET
    end = float(time[np.argmax(left)])
    return Onset(end, float(fit.mean(end)))


def _first_onset(time: np.ndarray, square: np.ndarray, happened: np.ndarray) -> Onset:
    """The first record for which `happened` (R,) is true."""
    if not happened.any():
        return NO_ONSET
    place = np.argmax(happened)
    return Onset(float(time[place]), float(square[place]))


def _sliding_until(time: float, times: np.ndarray, sliding: np.ndarray) -> float:
    """The largest number of sliding contacts up to a time; NaN without a time."""
    return float(sliding[times <= time].max()) if np.isfinite(time) else np.nan


def _diffusion_exponent(time: np.ndarray, square: np.ndarray, second: Onset) -> float:
    """The exponent of M − M_2 in t − t_2 over its last decade; NaN without a second instability."""
    since = time - second.time
    used = (since >= 0.1 * since[-1]) & (square > second.square)
    if not used.any():
        return np.nan
    since, grown = np.log10(since[used]), square[used] - second.square
    places = np.digitize(since, np.linspace(since[-1] - 1.0, since[-1], DIFFUSION_BINS + 1)[1:-1])
    filled = np.unique(places)
    if len(filled) < DIFFUSION_BINS:
        return np.nan
    times = [since[places == k].mean() for k in filled]
    means = [np.log10(grown[places == k].mean()) for k in filled]
    return float(np.polyfit(times, means, 1)[0])
