"""Claims of paper C on what follows the growth of a released pair: C6, C13 to C16.

    symbol       name                                                       paper C
    P, σ_xy, Z   release_start_*, release_after_*                           Figs. 7, 9
    P_ij         release_binary_tail_*: its 99 % quantile                   Fig. 10 (a)
    P_i at z     release_pressure_by_z_*                                    Fig. 10 (b)

Numbers are taken from each run without damping first; their mean and its error are those over the
samples.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_c.released import Released, released
from grainmodes.claims.part import MIN_SAMPLES, Part
from grainmodes.statistics.estimates import mean
from grainmodes.statistics.shares import share

if TYPE_CHECKING:
    import xarray as xr

MIN_LOG_SQUARE = 0.0
"""log10 of M, in d², at the end of a run, below which the grains have not left their places."""

HALF = 0.5

DIFFUSION_RANGE = (0.75, 1.25)
"""Range of the exponent of M in time that counts as diffusion."""


@claim("C6", unit="1")
def second_instability(ensemble: xr.Dataset) -> Outcome:
    """After a plateau a second instability raises P and lowers σ_xy and Z (Figs. 7, 9).

    The second instability begins where M exceeds the square of the mean overlap. The numbers are
    taken from the runs without damping that reach it: the length of the plateau, which is the time
    from the end of the growth in 1/ω_i; and log10 of the ratio of P, the ratio of |σ_xy| and the
    difference of Z, the contacts per grain, between the last tenth of the run and its start.

    Asked of: every listed growth rate with runs that reach a second instability.

    Criterion: The plateau is longer than 1/ω_i, P rises, |σ_xy| falls below 0.7 of its value, and Z
    falls.
    """
    quantities = ("pressure", "stress_xy", "contact_number")
    names = [f"{side}_{name}" for side in ("start", "after") for name in quantities]
    parts: list[Part] = []
    notes: list[str] = []
    for states, reached in _reaching(ensemble, notes, "end_time", *names):
        after = {name: states.undamped(f"after_{name}")[reached] for name in quantities}
        start = {name: states.values[f"start_{name}"][reached] for name in quantities}
        plateau = states.undamped("second_time") - states.undamped("end_time")
        pressure = np.log10(after["pressure"] / start["pressure"])
        stress = np.abs(after["stress_xy"] / start["stress_xy"])
        contacts = after["contact_number"] - start["contact_number"]
        parts += [
            Part(f"plateau, {states.where}", mean((plateau * states.rate)[reached]), low=1.0),
            Part(f"P, {states.where}", mean(pressure), low=0.0),
            Part(f"σ_xy, {states.where}", mean(stress), high=0.7),
            Part(f"Z, {states.where}", mean(contacts), high=0.0),
        ]
    return _outcome(parts, notes)


@claim("C13", unit="1")
def diffusive(ensemble: xr.Dataset) -> Outcome:
    """After the second instability the grains diffuse (Sec. VI B (4), Fig. 7).

    This is the exponent of M in the time since the second instability, over the last decade of this
    time, of the runs without damping that reach it. Where M at the end is below d² the grains
    have not left their places, and the run is too short to be compared.

    Asked of: every listed growth rate with runs that reach a second instability.

    Criterion: The exponent lies within 0.75 ... 1.25.
    """
    parts: list[Part] = []
    notes: list[str] = []
    names = ("diffusion_exponent", "after_mean_square_displacement")
    for states, reached in _reaching(ensemble, notes, *names):
        exponent = mean(states.undamped("diffusion_exponent")[reached])
        square = mean(np.log10(states.undamped("after_mean_square_displacement")[reached]))
        needs = "" if square.value > MIN_LOG_SQUARE else "runs to M ≥ d²"
        parts.append(Part(states.where, exponent, *DIFFUSION_RANGE, needs=needs))
        notes.append(f"There log10 M is {square} at the end.")
    return _outcome(parts, notes)


@claim("C14", unit="1")
def longer_tail(ensemble: xr.Dataset) -> Outcome:
    """After the second instability the distribution of P_ij has a longer tail (Fig. 10 (a)).

    This is log10 of the ratio of the 99 % quantiles of P_ij = r·f of the contacts, at the end of
    the runs without damping that reach the second instability over that at their start.

    Asked of: every listed growth rate with runs that reach a second instability.

    Criterion: The quantile rises.
    """
    parts: list[Part] = []
    notes: list[str] = []
    for states, reached in _reaching(ensemble, notes, "binary_tail_before", "binary_tail_after"):
        before, after = (states.values[f"binary_tail_{side}"] for side in ("before", "after"))
        ratio = mean(np.log10(after / before)[reached])
        parts.append(Part(states.where, ratio, low=0.0))
    return _outcome(parts, notes)


@claim("C15", unit="1")
def pressure_at_every_z(ensemble: xr.Dataset) -> Outcome:
    """After the second instability P_i is higher at every number z of contacts (Fig. 10 (b)).

    This is log10 of the ratio of the mean P_i of the grains with z contacts, at the end of the runs
    without damping that reach the second instability over that at their start, for every z with at
    least four grains on both sides in four samples.

    Asked of: every listed growth rate with runs that reach a second instability.

    Criterion: P_i rises at every z.
    """
    parts: list[Part] = []
    notes: list[str] = []
    for states, reached in _reaching(
        ensemble, notes, "pressure_by_z_before", "pressure_by_z_after"
    ):
        before, after = (states.values[f"pressure_by_z_{side}"] for side in ("before", "after"))
        with np.errstate(divide="ignore", invalid="ignore"):
            ratios = np.log10(after / before)[reached]
        for z in np.flatnonzero(np.isfinite(ratios).sum(axis=0) >= MIN_SAMPLES):
            parts.append(Part(f"z = {z}, {states.where}", mean(ratios[:, z]), low=0.0))
    return _outcome(parts, notes)


@claim("C16", unit="1")
def contacts_at_the_threshold(ensemble: xr.Dataset) -> Outcome:
    """Some contacts reach Coulomb's threshold as the growth ends, and more later (Fig. 9, inset).

    These are numbers of contacts at the threshold in the runs without damping that reach the second
    instability: the share of the runs in which the largest number until 2/ω_i after the end of the
    growth is above that of the start, and the mean over the last tenth of the run minus this
    largest number.

    Asked of: every listed growth rate with runs that reach a second instability.

    Criterion: The number rises by the end of the growth in more than one half of the runs, and is
    larger still at the end of the run.
    """
    parts: list[Part] = []
    notes: list[str] = []
    names = ("growth_sliding", "after_sliding")
    for states, reached in _reaching(ensemble, notes, "start_sliding", *names):
        growth, after = (states.undamped(name)[reached] for name in names)
        risen = growth - states.values["start_sliding"][reached]
        risen = share(np.where(np.isfinite(risen), risen > 0.0, np.nan))
        parts.append(Part(f"end of the growth, {states.where}", risen, low=HALF))
        parts.append(Part(f"end of the run, {states.where}", mean(after - growth), low=0.0))
    return _outcome(parts, notes)


def _reaching(
    ensemble: xr.Dataset, notes: list[str], *names: str
) -> Iterator[tuple[Released, np.ndarray]]:
    """The released states, and which samples (S,) reach the second instability; at least one does.

    A sentence that counts them is added to the notes.
    """
    for states in released(ensemble, "second_time", *names):
        reached = np.isfinite(states.undamped("second_time"))
        known = np.isfinite(states.rate)
        notes.append(f"{reached.sum()} of {known.sum()} runs at {states.where} reach it.")
        if reached.any():
            yield states, reached


def _outcome(parts: list[Part], notes: list[str]) -> Outcome:
    return Outcome({"runs that reach a second instability": parts}, " ".join(notes))
