"""Claims of paper C on unstable states that are let go: C4 to C7.

    symbol       name                                                       paper C
    ω_i, ω_r     release_rate_linear, release_frequency_linear              Eq. 12
    M, A         release_displacement_*, release_rotation_*: fitted laws    Eq. 30, Fig. 6
    η_0          release_damping, a run each; the first is 0                Sec. VII

Numbers of one run first, their mean and its error over the samples then.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from grainmodes.claims.claim import NotTested, Outcome, Part, claim
from grainmodes.claims.samples import Samples, best_sampled, label
from grainmodes.statistics.estimates import mean

TOLERANCE = 0.01
"""Relative difference of a fitted rate or frequency to linear theory."""

MIN_AXIS_RATIO = 0.1
"""Ratio of the axes of a grain's turn from which it is no line."""

LOG_CONTACT_CHANGE = -8.0
"""log10 of M, in d², above which contacts may change."""

LOG_CHANGE_RANGE = (-8.0, -6.0)
"""log10 of "M ~ 1e-7"."""

MAX_DELAY = 2.0
"""Time, in 1/ω_i, between the first change of contacts and the end of the growth."""


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

    A film of the growth is fitted with e^(ω_i t) Re(z e^(-iω_r t)) for every coordinate.

    Criterion: it leaves less than 5 % of the motion; z overlaps with the eigenvector to 1 %; the
    axes of a grain's turn have a ratio above 0.1 in the median.
    """
    parts = []
    for where, of in released(ensemble, *(f"spiral_{x}" for x in ("misfit", "overlap", "opening"))):
        parts.append(Part(f"left over, {where}", mean(of["spiral_misfit"]), high=0.05))
        parts.append(Part(f"overlap, {where}", mean(of["spiral_overlap"]), low=1.0 - TOLERANCE))
        parts.append(Part(f"opening, {where}", mean(of["spiral_opening"]), low=MIN_AXIS_RATIO))
    return Outcome(parts)


@claim("C5", unit="1")
def growth(ensemble) -> Outcome:
    """M(t) and A(t) grow as e^(2ω_i t), turning with ω_r, up to M ~ 1e-7 (Figs. 6, 7).

    Of the run without damping: fitted rate and frequency of M and A over ω_i and ω_r, minus 1;
    log10 of M when contacts change first; the time from there to the end of the growth, in 1/ω_i.

    Criterion: rates and frequencies within ±1 %; log10 M within -8 ... -6; the time within ±2.
    """
    fits = [f"{of}_{name}" for of in SQUARES for name in ("rate", "frequency")]
    depths = [f"{of}_depth" for of in SQUARES]
    moments = ("change_square", "change_time", "end_time")
    parts, notes = [], []
    for where, of in released(ensemble, "frequency_linear", *fits, *depths, *moments):
        for name in fits:
            linear = of[f"{name.rpartition('_')[2]}_linear"]
            off = mean(of[name][:, 0] / linear - 1.0)
            parts.append(Part(f"{name.replace('_', ', ')}, {where}", off, -TOLERANCE, TOLERANCE))
        size = mean(np.log10(of["change_square"][:, 0]))
        parts.append(Part(f"first change, {where}", size, *LOG_CHANGE_RANGE))
        later = (of["end_time"] - of["change_time"])[:, 0] * of["rate_linear"]
        parts.append(Part(f"end after it, {where}", mean(later), -MAX_DELAY, MAX_DELAY))
        swing = " and ".join(f"{mean(of[name][:, 0])}" for name in depths)
        notes.append(
            f"At {where} M and A swing by {swing} of their means; e^(2ω_i t) sin²(ω_r t) would "
            "swing by 1: only the first turns after a kick do."
        )
    return Outcome(parts, " ".join(notes))


SQUARES = ("displacement", "rotation")
"""The laws of M and of A."""


@claim("C6", unit="1")
def second_instability(ensemble) -> Outcome:
    """After a plateau a second instability raises P and lowers σ_xy and the contacts (Figs. 7, 9).

    It begins where M exceeds the square of the mean overlap. Of the runs without damping that come
    to it: the time from the end of the growth, in 1/ω_i; log10 of P, the ratio of σ_xy and the
    difference of the contacts of a grain between the last tenth of the run and the start.

    Criterion: the time above 1; log10 P rises; σ_xy falls below 0.7 of itself; contacts fall.
    """
    quantities = ("pressure", "stress_xy", "contact_number")
    names = [f"{side}_{name}" for side in ("start", "after") for name in quantities]
    parts, notes = [], []
    for where, of in released(ensemble, "end_time", "second_time", *names):
        came = np.isfinite(of["second_time"][:, 0])
        known = np.isfinite(of["rate_linear"])
        notes.append(f"{came.sum()} of {known.sum()} runs at {where} come to it.")
        if not came.any():
            continue
        after = {name: of[f"after_{name}"][came, 0] for name in quantities}
        start = {name: of[f"start_{name}"][came] for name in quantities}
        plateau = ((of["second_time"] - of["end_time"])[:, 0] * of["rate_linear"])[came]
        pressure = np.log10(after["pressure"] / start["pressure"])
        stress = np.abs(after["stress_xy"] / start["stress_xy"])
        contacts = after["contact_number"] - start["contact_number"]
        parts += [
            Part(f"plateau, {where}", mean(plateau), low=1.0),
            Part(f"P, {where}", mean(pressure), low=0.0),
            Part(f"σ_xy, {where}", mean(stress), high=0.7),
            Part(f"contacts, {where}", mean(contacts), high=0.0),
        ]
    if not parts:
        raise NotTested("runs that come to a second instability")
    return Outcome(parts, " ".join(notes))


@claim("C7", unit="1")
def damping(ensemble) -> Outcome:
    """A damping η_0 above ω_i suppresses the growth, a smaller one does not (Fig. 11).

    log10 of the largest M of every run, in d². Linear theory lets the pair grow at ω_i - η_0/2, so
    that runs with ω_i ≤ η_0 ≤ 2ω_i stand between and are not judged. Noted is which runs come to a
    second instability: those that grow may yet come to rest nearby.

    Criterion: above -8 for η_0 < ω_i, below -8 for η_0 > 2ω_i.
    """
    parts, notes = [], []
    names = ("damping", "largest_square", "displacement_rate", "second_time")
    for where, of in released(ensemble, *names):
        ratio = np.nanmean(of["damping"] / of["rate_linear"][:, None], axis=0)
        known = np.isfinite(of["rate_linear"]).sum()
        came = np.isfinite(of["second_time"]).sum(axis=0)
        for run, times in enumerate(ratio):
            name = f"η_0 = {times:.3g} ω_i, {where}"
            if times < 2.0 + TOLERANCE:
                notes.append(f"At {name} {came[run]} of {known} come to a second instability.")
            largest = mean(np.log10(of["largest_square"][:, run]))
            if times < 1.0 - TOLERANCE:
                parts.append(Part(name, largest, low=LOG_CONTACT_CHANGE))
            elif times > 2.0 + TOLERANCE:
                parts.append(Part(name, largest, high=LOG_CONTACT_CHANGE))
            else:
                rate = mean(of["displacement_rate"][:, run] / of["rate_linear"])
                notes.append(f"At {name} M grows to log10 M = {largest}, at {rate} ω_i.")
    return Outcome(parts, " ".join(notes))
