"""Claims of paper B on the states before a plastic event: B3 and B4.

    symbol       name                                                       paper B
    γ_c          middle of the bracket of an event                          App. B
    λ_min        Curve.lowest_eigenvalue                                    Figs. 3, 7, 13
    g            Curve.modulus                                              Figs. 3, 7

"Before an event" means the states that lead up to it without any change of contacts, at most over
the last few steps Δγ_in (`ensemble.curves.Approach`). Shares are those of all events, judged by the
number of events and of samples (`PooledShare`). Averages run over the events of each sample first,
and then over the samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_b.sheared import (
    LARGEST,
    MIN_SHARE,
    TOLERANCE,
    measured,
    over_samples,
    sheared,
)
from grainmodes.claims.part import Part
from grainmodes.ensemble.curves import Approach, Curve
from grainmodes.statistics.shares import pooled_share

if TYPE_CHECKING:
    import xarray as xr

MAX_TREND = 0.05
"""Relative change of λ_min before an event that counts as a precursor; a square root gives 1."""

MIN_JUMP_RATIO = 10.0
"""Ratio of the change of λ_min in an event to its trend before, above which it is a jump."""

MIN_STATES = 5
"""Smallest number of states for a fit of a singular and a regular part."""


@claim("B3", unit="1")
def jump_without_precursor(ensemble: xr.Dataset) -> Outcome:
    """The smallest eigenvalue λ_min jumps at γ_c without a precursor (Figs. 3, 7, 13).

    The trend is the relative change of λ_min over the states before an event, averaged over the
    events of a sample. A jump is a change of λ_min by more than ten times the change that its trend
    gives for the same step; B shows one at a large drop of the stress. The mode of λ_min may belong
    to another place than a small event, which is therefore not asked to jump.

    Asked of: every point with events; jumps of the largest tenth of the drops of every sample.

    Criterion: λ_min changes by less than 5 % before an event, and jumps in more than 90 % of the
    largest drops.
    """
    trends, jumps, notes = [], [], []
    for where, curves in sheared(ensemble, "curve_lowest_eigenvalue"):
        trends.append(Part(f"trend, {where}", over_samples(curves, _trend), -MAX_TREND, MAX_TREND))
        largest = pooled_share(_jumps_in_large_drops(curve) for curve in curves)
        jumps.append(Part(f"jumps of the largest drops, {where}", largest, MIN_SHARE))
        changes = np.concatenate([_trends(curve) for curve in curves])
        every = pooled_share(_jumps(curve) for curve in curves)
        size, falls = over_samples(curves, _size_of_jump), (changes < -MAX_TREND).sum()
        notes.append(
            f"At {where} λ_min jumps in {every}; its relative change in an event is {size}; before "
            f"{falls} of {len(changes)} events it falls by more than 5 %."
        )
    groups = {
        "λ_min of states before events": measured(trends),
        "λ_min of states before large drops": measured(jumps),
    }
    return Outcome(groups, " ".join(notes))


def _approaches(curve: Curve, min_states: int) -> list[Approach]:
    return [a for a in curve.approaches if a.last - a.first + 1 >= min_states]


def _trends(curve: Curve) -> np.ndarray:
    approaches = _approaches(curve, 2)
    first, last = (curve.lowest_eigenvalue[[a[side] for a in approaches]] for side in (0, 1))
    return (last - first) / np.abs(first)


def _trend(curve: Curve) -> float:
    return np.mean(_trends(curve)) if _approaches(curve, 2) else np.nan


def _jumps(curve: Curve) -> np.ndarray:
    """Whether λ_min jumps (1 or 0), for every event with an approach of two states.

    NaN where the curve has no λ_min.
    """
    sudden = []
    for first, last in _approaches(curve, 2):
        slope = (curve.lowest_eigenvalue[last] - curve.lowest_eigenvalue[first]) / (
            curve.strain[last] - curve.strain[first]
        )
        change = curve.lowest_eigenvalue[last + 1] - curve.lowest_eigenvalue[last]
        sudden.append(abs(change) > MIN_JUMP_RATIO * abs(slope) * curve.step[last])
    known = np.isfinite(curve.lowest_eigenvalue).all()
    return np.array(sudden, float) if known else np.full(len(sudden), np.nan)


def _jumps_in_large_drops(curve: Curve) -> np.ndarray:
    return _jumps(curve)[_is_large(curve, _approaches(curve, 2))]


def _is_large(curve: Curve, approaches: list[Approach]) -> np.ndarray:
    """Which of these events are among the largest tenth of the drops of σ of the whole sample."""
    drops = -curve.stress_change[curve.event]
    own = -curve.stress_change[[approach.last for approach in approaches]]
    return own >= np.quantile(drops, 1.0 - LARGEST) if len(drops) else np.zeros(0, bool)


def _size_of_jump(curve: Curve) -> float:
    (last,) = np.nonzero(curve.event)
    change = np.abs(curve.lowest_eigenvalue[last + 1] - curve.lowest_eigenvalue[last]) / np.abs(
        curve.lowest_eigenvalue[last]
    )
    return np.mean(change) if len(last) else np.nan


@claim("B4", unit="1")
def no_singularity(ensemble: xr.Dataset) -> Outcome:
    """The rigidity has no singularity -(γ_c - γ)^(-1/2) below γ_c (Fig. 3).

    g of the states before an event is fitted by a + b (γ_c - γ) + A (γ_c - γ)^(-1/2). The measured
    number is the share of the events in which the last term, at the last of these states, is within
    ±1 % of the mean |g| of the sample; of all events, and of the largest tenth of the drops of σ of
    every sample.

    Asked of: every point with events that five states lead up to.

    Criterion: The singular term is within ±1 % of the mean |g| in more than 90 % of the events and
    of the largest drops.
    """
    every, largest, notes = [], [], []
    for where, curves in sheared(ensemble, "curve_g_xy"):
        of_all = pooled_share(_regular(curve) for curve in curves)
        every.append(Part(f"all events, {where}", of_all, MIN_SHARE))
        of_large = pooled_share(_regular_in_large_drops(curve) for curve in curves)
        largest.append(Part(f"largest drops, {where}", of_large, MIN_SHARE))
        term = over_samples(curves, _mean_singular)
        notes.append(f"At {where} the mean singular term is {term} of the mean |g|.")
    groups = {
        f"events with {MIN_STATES} states before them": measured(every),
        f"large drops with {MIN_STATES} states before them": measured(largest),
    }
    return Outcome(groups, " ".join(notes))


def _singular_terms(curve: Curve) -> np.ndarray:
    """The singular term of every event that enough states lead up to, over the mean |g|."""
    terms = [_singular_term(curve, approach) for approach in _approaches(curve, MIN_STATES)]
    return np.array(terms) / np.abs(curve.modulus).mean()


def _mean_singular(curve: Curve) -> float:
    terms = _singular_terms(curve)
    return float(terms.mean()) if len(terms) else np.nan


def _regular(curve: Curve) -> np.ndarray:
    """Whether the singular term is small (1 or 0), for every event with enough states before it."""
    terms = np.abs(_singular_terms(curve))
    return np.where(np.isfinite(terms), terms < TOLERANCE, np.nan)


def _regular_in_large_drops(curve: Curve) -> np.ndarray:
    return _regular(curve)[_is_large(curve, _approaches(curve, MIN_STATES))]


def _singular_term(curve: Curve, approach: Approach) -> float:
    critical = curve.strain[approach.last : approach.last + 2].mean()
    distance = critical - curve.strain[approach.states]
    terms = np.stack([np.ones(len(distance)), distance, distance**-0.5], axis=1)
    scale = np.abs(terms).max(axis=0)
    fit = np.linalg.lstsq(terms / scale, curve.modulus[approach.states], rcond=None)[0]
    return fit[2] * terms[-1, 2] / scale[2]
