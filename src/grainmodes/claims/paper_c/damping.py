"""The claim of paper C on damping: C7.

symbol       name                                                       paper C
η_0          release_damping, one run for each; the first is 0          Sec. VII
Re s         release_rate_damped: the quadratic eigenproblem            Sec. VII
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_c.released import Released, released
from grainmodes.claims.part import MIN_SAMPLES, Part
from grainmodes.statistics.estimates import mean

if TYPE_CHECKING:
    import xarray as xr

MAX_DIFFERENCE = 0.02
"""Difference of a fitted rate to the quadratic eigenproblem, in units of ω_i, that is none."""

WEAK, STRONG = 0.5, 2.0
"""η_0 over ω_i below which a damping is weak, and over the threshold above which it is strong."""

MIN_LOG_RATIO = -1.0
"""log10 of the largest M over that at the end of the growth without damping, above which the growth
has not been suppressed."""

SUPPRESSED = -15.0
"""log10 of M, in d², below which nothing has grown."""


@claim("C7", unit="1")
def damping(ensemble: xr.Dataset) -> Outcome:
    """A damping η_0 above ω_i suppresses the growth, and a smaller one does not (Fig. 11).

    C says η_0 ≳ ω_i, an order of magnitude: linear theory, the quadratic eigenproblem, has the
    growth end at a threshold of a few ω_i, which the note states. For every decade of ω_i and every
    run with damping these are: where M grows, the difference of the rate fitted to M to linear
    theory, in ω_i; for η_0 < 0.5 ω_i, log10 of the largest M over M at the end of the growth
    without damping; above twice the threshold, log10 of the largest M.

    Asked of: every listed growth rate with four released states; among their runs some whose M
    grows under a drag, some with η_0 < 0.5 ω_i, and some above twice the threshold.

    Criterion: Rates are within ±0.02 ω_i of linear theory, weak damping leaves the growth within a
    decade of M, and strong damping keeps log10 M below -15.
    """
    rates: list[Part] = []
    weak: list[Part] = []
    strong: list[Part] = []
    notes = []
    names = ("damping", "rate_damped", "threshold", "largest_square", "end_square", "second_time")
    for states in released(ensemble, *names, "displacement_rate"):
        threshold = mean(states.values["threshold"] / states.rate)
        runs = range(1, states.values["damping"].shape[1])
        for run in runs:
            times = _times(states, run)
            rates += _rate_parts(states, run)
            weak += [_growth_part(states, run)] if times < WEAK else []
            strong += [_no_growth_part(states, run)] if times > STRONG * threshold.value else []
        grown = filter(None, (_sentence(states, run) for run in runs))
        notes.append("; ".join([f"{states.where}: the threshold is {threshold} ω_i", *grown]) + ".")
    groups = {
        "released states that grow under a drag": rates,
        "runs with η_0 < 0.5 ω_i": weak,
        "runs with η_0 above twice the threshold": strong,
    }
    return Outcome(groups, " ".join(notes))


def _times(states: Released, run: int) -> float:
    """η_0 of a run over ω_i."""
    return float(np.nanmedian(states.values["damping"][:, run] / states.rate))


def _rates(states: Released, run: int) -> tuple[np.ndarray, np.ndarray]:
    """The fitted rate and that of linear theory, (S,) each, in ω_i."""
    names = ("displacement_rate", "rate_damped")
    fitted, theory = (states.values[name][:, run] / states.rate for name in names)
    return fitted, theory


def _named(states: Released, run: int) -> str:
    return f"η_0 = {_times(states, run):.3g} ω_i, {states.where}"


def _largest(states: Released, run: int) -> np.ndarray:
    """log10 of the largest M of a run, (S,)."""
    return np.log10(states.values["largest_square"][:, run])


def _rate_parts(states: Released, run: int) -> list[Part]:
    """The fitted rate minus that of linear theory, if enough samples grow."""
    fitted, theory = _rates(states, run)
    if np.isfinite(fitted).sum() < MIN_SAMPLES:
        return []
    difference = mean(fitted - theory)
    return [Part(f"rate, {_named(states, run)}", difference, -MAX_DIFFERENCE, MAX_DIFFERENCE)]


def _growth_part(states: Released, run: int) -> Part:
    ratio = mean(_largest(states, run) - np.log10(states.undamped("end_square")))
    return Part(f"growth, {_named(states, run)}", ratio, low=MIN_LOG_RATIO)


def _no_growth_part(states: Released, run: int) -> Part:
    return Part(f"no growth, {_named(states, run)}", mean(_largest(states, run)), high=SUPPRESSED)


def _sentence(states: Released, run: int) -> str:
    """How fast M grows under one damping, and what follows; nothing where M does not grow."""
    fitted, theory = _rates(states, run)
    if not np.isfinite(fitted).any():
        return ""
    reached = np.isfinite(states.values["second_time"][:, run]).sum()
    return (
        f"under η_0 = {_times(states, run):.3g} ω_i M grows at {mean(fitted)} ω_i, theory "
        f"{mean(theory)} ω_i, and {reached} of {np.isfinite(states.rate).sum()} reach a second "
        "instability"
    )
