"""Claims of paper B on plastic events: B3, B4, B7 and B9.

    symbol       name                                                       paper B
    γ_c          middle of the bracket of an event                          App. B
    λ_min        Curve.lowest_eigenvalue                                    Figs. 3, 7, 13
    g            Curve.modulus                                              Figs. 3, 7

"Before an event" means the states that lead up to it without any change of contacts, at most over
the last few steps Δγ_in (`ensemble.curves.Approach`). Averages run over the events of each sample
first, and then over the samples.
"""

from __future__ import annotations

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_b.sheared import TOLERANCE, harmonic, over_samples, sheared
from grainmodes.claims.part import Part
from grainmodes.claims.samples import label
from grainmodes.ensemble.curves import Approach, Curve
from grainmodes.statistics.estimates import mean

MAX_TREND = 0.05
"""Relative change of λ_min before an event that counts as a precursor; a square root gives 1."""

MIN_JUMP_RATIO = 10.0
"""Ratio of the change of λ_min in an event to its trend before, above which it is a jump."""

MIN_SHARE = 0.9
"""Share of the events that counts as all; the lowest mode may belong to another place."""

POLE_NAMES = ("event_quadrupole", "event_other_multipoles")

PURE_QUADRUPOLE = 0.617
"""p_2 of rotations proportional to cos 2ϑ: (π/4)²."""

MIN_STATES = 5
"""Smallest number of states for a fit of a singular and a regular part."""


@claim("B3", unit="1")
def jump_without_precursor(ensemble) -> Outcome:
    """The smallest eigenvalue λ_min jumps at γ_c without a precursor (Figs. 3, 7, 13).

    The trend is the relative change of λ_min over the states before an event, averaged over events.
    The jumps are the share of the events in which λ_min changes by more than ten times the change
    that its trend gives for the same step.

    Asked of: every point with events.

    Criterion: λ_min changes by less than 5 % before an event, and jumps in more than 90 % of
    events.
    """
    parts, notes = [], []
    for where, curves in sheared(ensemble, "curve_lowest_eigenvalue"):
        parts.append(Part(f"trend, {where}", over_samples(curves, _trend), -MAX_TREND, MAX_TREND))
        parts.append(Part(f"jumps, {where}", over_samples(curves, _share_of_jumps), MIN_SHARE))
        changes = np.concatenate([_trends(curve) for curve in curves])
        size = over_samples(curves, _size_of_jump)
        notes.append(
            f"At {where} the relative change of λ_min in an event is {size}; before "
            f"{(changes < -MAX_TREND).sum()} of {len(changes)} events it falls by more than 5 %."
        )
    return Outcome({"λ_min of states before events": _measured(parts)}, " ".join(notes))


def _measured(parts: list[Part]) -> list[Part]:
    return [part for part in parts if np.isfinite(part.measured.value)]


def _approaches(curve: Curve, min_states: int) -> list[Approach]:
    return [a for a in curve.approaches if a.last - a.first + 1 >= min_states]


def _trends(curve: Curve) -> np.ndarray:
    approaches = _approaches(curve, 2)
    first, last = (curve.lowest_eigenvalue[[a[side] for a in approaches]] for side in (0, 1))
    return (last - first) / np.abs(first)


def _trend(curve: Curve) -> float:
    return np.mean(_trends(curve)) if _approaches(curve, 2) else np.nan


def _share_of_jumps(curve: Curve) -> float:
    sudden = []
    for first, last in _approaches(curve, 2):
        slope = (curve.lowest_eigenvalue[last] - curve.lowest_eigenvalue[first]) / (
            curve.strain[last] - curve.strain[first]
        )
        change = curve.lowest_eigenvalue[last + 1] - curve.lowest_eigenvalue[last]
        sudden.append(abs(change) > MIN_JUMP_RATIO * abs(slope) * curve.step[last])
    return np.mean(sudden) if sudden and np.isfinite(curve.lowest_eigenvalue).all() else np.nan


def _size_of_jump(curve: Curve) -> float:
    (last,) = np.nonzero(curve.event)
    change = np.abs(curve.lowest_eigenvalue[last + 1] - curve.lowest_eigenvalue[last]) / np.abs(
        curve.lowest_eigenvalue[last]
    )
    return np.mean(change) if len(last) else np.nan


@claim("B4", unit="1")
def no_singularity(ensemble) -> Outcome:
    """The rigidity has no singularity -(γ_c - γ)^(-1/2) below γ_c (Fig. 3).

    g of the states before an event is fitted by a + b (γ_c - γ) + A (γ_c - γ)^(-1/2). The measured
    number is the last term at the last of these states, over the mean |g| of the sample.

    Asked of: every point with events that five states lead up to.

    Criterion: The singular term is within ±1 % of the mean |g|.
    """
    parts = [
        Part(where, over_samples(curves, _singular), -TOLERANCE, TOLERANCE)
        for where, curves in sheared(ensemble, "curve_g_xy")
    ]
    return Outcome({f"events with {MIN_STATES} states before them": _measured(parts)})


def _singular(curve: Curve) -> float:
    terms = [_singular_term(curve, approach) for approach in _approaches(curve, MIN_STATES)]
    return np.mean(terms) / np.abs(curve.modulus).mean() if terms else np.nan


def _singular_term(curve: Curve, approach: Approach) -> float:
    critical = curve.strain[approach.last : approach.last + 2].mean()
    distance = critical - curve.strain[approach.states]
    terms = np.stack([np.ones(len(distance)), distance, distance**-0.5], axis=1)
    scale = np.abs(terms).max(axis=0)
    fit = np.linalg.lstsq(terms / scale, curve.modulus[approach.states], rcond=None)[0]
    return fit[2] * terms[-1, 2] / scale[2]


@claim("B7", unit="1")
def quadrupole_of_rotations(ensemble) -> Outcome:
    """Domains of rotating grains in an event form a quadrupole (Fig. 6).

    p_m is |Σ Δℓ exp(i m ϑ)|² / (Σ |Δℓ|)² around the grain that moves farthest, averaged over the
    events. If Δℓ is proportional to cos 2ϑ, p_2 is 0.62.

    Asked of: every point with events.

    Criterion: p_2 is above 0.31, half of its value for cos 2ϑ.
    """
    samples = harmonic(ensemble, "event_quadrupole")
    parts, notes = [], []
    for point in samples.points("event_quadrupole"):
        quadrupole, others = (_by_sample(samples.values(name, *point)) for name in POLE_NAMES)
        parts.append(Part(label(*point), mean(quadrupole), low=0.5 * PURE_QUADRUPOLE))
        excess = mean(quadrupole - others)
        notes.append(f"At {label(*point)} p_2 exceeds the mean of p_1, p_3 and p_4 by {excess}.")
    return Outcome({"events": _measured(parts)}, " ".join(notes))


def _by_sample(values: np.ndarray) -> np.ndarray:
    """Mean over the events of each sample, for samples with events."""
    known = np.isfinite(values).any(axis=1)
    return np.nanmean(values[known], axis=1)


@claim("B9", unit="1")
def contacts_at_events(ensemble) -> Outcome:
    """Contacts open or close at every plastic event (Sec. IV, Fig. 8).

    This is the share of the events in which a contact opened, or closed, or opened and closed again
    with its spring unloaded.

    Asked of: every point with events.

    Criterion: A contact opens or closes in more than 90 % of the events.
    """
    names = ("event_opened", "event_closed", "event_reopened")
    samples = harmonic(ensemble, "curve_strain", *names)
    parts, notes = [], []
    for point in samples.points("curve_strain"):
        kind, *changes = (samples.values(name, *point) for name in ("event_kind", *names))
        happened = kind > 0
        changed, lasting = (
            np.where(happened, sum(counts) > 0, np.nan) for counts in (changes, changes[:2])
        )
        parts.append(Part(label(*point), mean(_share(changed)), MIN_SHARE))
        opened, closed, again = (int(counts[happened].sum()) for counts in changes)
        notes.append(
            f"In {happened.sum()} events at {label(*point)} {opened} contacts opened, "
            f"{closed} closed and {again} did both; the share of the events of a sample with the "
            f"same network before and after is {mean(1.0 - _share(lasting))}."
        )
    return Outcome({"events": _measured(parts)}, " ".join(notes))


def _share(happened: np.ndarray) -> np.ndarray:
    """Share of each sample, (S,), from (S, E) of 1 and 0, NaN where there is no event."""
    known = np.isfinite(happened).sum(axis=1)
    with np.errstate(invalid="ignore"):
        return np.where(known > 0, np.nansum(happened, axis=1) / known, np.nan)
