"""Claims of paper C on released unstable states: C4 to C7.

    symbol       name                                                       paper C
    ω_i, ω_r     release_rate_linear, release_frequency_linear              Eq. 12
    M, A         release_displacement_*, release_rotation_*: fits           Eq. 30, Fig. 6
    η_0          release_damping, one run for each; the first is 0          Sec. VII

Numbers are taken from each run first; their mean and its error are those over the samples.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, best_sampled, label
from grainmodes.statistics.estimates import mean

TOLERANCE = 0.01
"""Relative difference to linear theory at which a fitted rate or frequency is equal to it."""

MIN_AXIS_RATIO = 0.1
"""Ratio of the axes of a grain's ellipse above which it is not a straight line."""

LOG_CONTACT_CHANGE = -8.0
"""log10 of M, in d², above which contacts may change."""

LOG_CHANGE_RANGE = (-8.0, -6.0)
"""Range of log10 M that counts as "M ~ 1e-7"."""

MAX_DELAY = 2.0
"""Longest time, in 1/ω_i, between the first change of contacts and the end of the growth."""


def released(ensemble, *names: str) -> Iterator[tuple[str, dict[str, np.ndarray]]]:
    """The name of every point with released samples, and their values by name.

    Raises:
        NotTested: the ensemble lacks one of the variables, or released samples.
    """
    names = ("rate_linear", *names)
    absent = [f"release_{name}" for name in names if f"release_{name}" not in ensemble]
    if absent:
        raise NotTested(", ".join(absent))
    samples = best_sampled(ensemble, "release_rate_linear")
    for point in samples.points("release_rate_linear"):
        yield label(*point), _values(samples, point, names)


def _values(samples: Samples, point: tuple[float, float], names) -> dict[str, np.ndarray]:
    return {name: samples.values(f"release_{name}", *point) for name in names}


@claim("C4", unit="1")
def spirals(ensemble) -> Outcome:
    """The grains of a growing complex pair move on spirals along its eigenvector (Fig. 5).

    The growth of every coordinate is fitted by e^(ω_i t) Re(z e^(-iω_r t)). The measured numbers
    are the part of the motion that the fit leaves, the overlap of z with the eigenvector, and the
    median ratio of the axes of the ellipse of a grain.

    Asked of: every point with released samples.

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
    return Outcome({"released samples": parts})


@claim("C5", unit="1")
def growth(ensemble) -> Outcome:
    """M(t) and A(t) grow as e^(2ω_i t) and oscillate with ω_r up to M ~ 1e-7 (Figs. 6, 7).

    The numbers are taken from the run without damping: the relative differences of the fitted rates
    and frequencies of M and A to ω_i and ω_r; log10 of M at the first change of contacts; and the
    time from this change to the end of the growth, in 1/ω_i.

    Asked of: every point with released samples.

    Criterion: Rates and frequencies are within ±1 % of linear theory, log10 M at the first change
    of contacts lies within -8 ... -6, and the growth ends within ±2/ω_i of this change.
    """
    fits = [f"{square}_{name}" for square in SQUARES for name in ("rate", "frequency")]
    depths = [f"{square}_depth" for square in SQUARES]
    moments = ("change_square", "change_time", "end_time")
    parts, notes = [], []
    for where, values in released(ensemble, "frequency_linear", *fits, *depths, *moments):
        for name in fits:
            linear = values[f"{name.rpartition('_')[2]}_linear"]
            difference = mean(values[name][:, 0] / linear - 1.0)
            part = f"{name.replace('_', ', ')}, {where}"
            parts.append(Part(part, difference, -TOLERANCE, TOLERANCE))
        square = mean(np.log10(values["change_square"][:, 0]))
        parts.append(Part(f"first change, {where}", square, *LOG_CHANGE_RANGE))
        later = (values["end_time"] - values["change_time"])[:, 0] * values["rate_linear"]
        parts.append(
            Part(f"time to the end of the growth, {where}", mean(later), -MAX_DELAY, MAX_DELAY)
        )
        depth = " and ".join(f"{mean(values[name][:, 0])}" for name in depths)
        notes.append(
            f"At {where} M and A oscillate by {depth} of their means. For e^(2ω_i t) sin²(ω_r t) "
            "this would be 1, as it is only in the first periods after a kick."
        )
    return Outcome({"released samples": parts}, " ".join(notes))


SQUARES = ("displacement", "rotation")
"""The prefixes of the fits of M and of A."""


@claim("C6", unit="1")
def second_instability(ensemble) -> Outcome:
    """After a plateau a second instability raises P and lowers σ_xy and Z (Figs. 7, 9).

    The second instability begins where M exceeds the square of the mean overlap. The numbers are
    taken from the runs without damping that reach it: the length of the plateau, which is the time
    from the end of the growth in 1/ω_i; and log10 of the ratio of P, the ratio of |σ_xy| and the
    difference of Z, the contacts per grain, between the last tenth of the run and its start.

    Asked of: every point with runs that reach a second instability.

    Criterion: The plateau is longer than 1/ω_i, P rises, |σ_xy| falls below 0.7 of its value, and Z
    falls.
    """
    quantities = ("pressure", "stress_xy", "contact_number")
    names = [f"{side}_{name}" for side in ("start", "after") for name in quantities]
    parts, notes = [], []
    for where, values in released(ensemble, "end_time", "second_time", *names):
        reached = np.isfinite(values["second_time"][:, 0])
        known = np.isfinite(values["rate_linear"])
        notes.append(f"{reached.sum()} of {known.sum()} runs at {where} reach it.")
        if not reached.any():
            continue
        after = {name: values[f"after_{name}"][reached, 0] for name in quantities}
        start = {name: values[f"start_{name}"][reached] for name in quantities}
        plateau = ((values["second_time"] - values["end_time"])[:, 0] * values["rate_linear"])[
            reached
        ]
        pressure = np.log10(after["pressure"] / start["pressure"])
        stress = np.abs(after["stress_xy"] / start["stress_xy"])
        contacts = after["contact_number"] - start["contact_number"]
        parts += [
            Part(f"plateau, {where}", mean(plateau), low=1.0),
            Part(f"P, {where}", mean(pressure), low=0.0),
            Part(f"σ_xy, {where}", mean(stress), high=0.7),
            Part(f"Z, {where}", mean(contacts), high=0.0),
        ]
    return Outcome({"runs that reach a second instability": parts}, " ".join(notes))


@claim("C7", unit="1")
def damping(ensemble) -> Outcome:
    """A damping η_0 above ω_i suppresses the growth, and a smaller one does not (Fig. 11).

    This is log10 of the largest M of every run, in d². In linear theory the pair grows at the rate
    ω_i - η_0/2, so that runs with ω_i ≤ η_0 ≤ 2ω_i are between the two cases and are not judged.
    The note lists the runs that reach a second instability, because a run that grows may still come
    to rest near its start.

    Asked of: every point with released samples, and every damping below ω_i or above 2ω_i.

    Criterion: The largest log10 M is above -8 for η_0 < ω_i, and below -8 for η_0 > 2ω_i.
    """
    parts, notes = [], []
    names = ("damping", "largest_square", "displacement_rate", "second_time")
    for where, values in released(ensemble, *names):
        ratio = np.nanmean(values["damping"] / values["rate_linear"][:, None], axis=0)
        known = np.isfinite(values["rate_linear"]).sum()
        reached = np.isfinite(values["second_time"]).sum(axis=0)
        for run, times in enumerate(ratio):
            name = f"η_0 = {times:.3g} ω_i, {where}"
            if times < 2.0 + TOLERANCE:
                notes.append(f"At {name} {reached[run]} of {known} reach a second instability.")
            largest = mean(np.log10(values["largest_square"][:, run]))
            if times < 1.0 - TOLERANCE:
                parts.append(Part(name, largest, low=LOG_CONTACT_CHANGE))
            elif times > 2.0 + TOLERANCE:
                parts.append(Part(name, largest, high=LOG_CONTACT_CHANGE))
            else:
                rate = mean(values["displacement_rate"][:, run] / values["rate_linear"])
                notes.append(f"At {name} M grows to log10 M = {largest}, at the rate {rate} ω_i.")
    return Outcome({"released samples": parts}, " ".join(notes))
