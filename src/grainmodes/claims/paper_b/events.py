"""Claims of paper B on plastic events: B3, B4, B7, B9 and B14.

    symbol       name                                                       paper B
    γ_c          middle of the bracket of an event                          App. B
    λ_min        Curve.lowest_eigenvalue                                    Figs. 3, 7, 13
    g            Curve.modulus                                              Figs. 3, 7

"Before an event" means the states that lead up to it without any change of contacts, at most over
the last few steps Δγ_in (`ensemble.curves.Approach`). Averages run over the events of each sample
first, and then over the samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_b.sheared import TOLERANCE, harmonic, over_samples, sheared
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, label
from grainmodes.ensemble.curves import Approach, Curve
from grainmodes.statistics.estimates import mean

if TYPE_CHECKING:
    import xarray as xr

MAX_TREND = 0.05
"""Relative change of λ_min before an event that counts as a precursor; a square root gives 1."""

MIN_JUMP_RATIO = 10.0
"""Ratio of the change of λ_min in an event to its trend before, above which it is a jump."""

MIN_SHARE = 0.9
"""Share of the events that counts as all; the lowest mode may belong to another place."""

LARGEST = 0.1
"""Share of the events of a sample that are its largest drops."""

POLE_NAMES = ("event_quadrupole_rank", "event_quadrupole", "event_other_multipoles")

MAX_RANK = 0.05
"""Rank of p_2 among permutations up to which the rotations are not at random."""

QUADRUPOLE_N = 1024
"""N of B, Figs. 4 to 6: four domains need room."""

EARLY_EVENTS, LATE_EVENTS, FAR_STRAIN = 0.05, 0.25, 0.34
"""Strains up to which events are early, and from which they are late; that of B, Fig. 3."""

PURE_QUADRUPOLE = 0.617
"""p_2 of rotations proportional to cos 2ϑ: (π/4)²."""

MIN_STATES = 5
"""Smallest number of states for a fit of a singular and a regular part."""


@claim("B3", unit="1")
def jump_without_precursor(ensemble) -> Outcome:
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
        largest = over_samples(curves, _share_of_jumps_in_large_drops)
        jumps.append(Part(f"jumps of the largest drops, {where}", largest, MIN_SHARE))
        changes = np.concatenate([_trends(curve) for curve in curves])
        size, all_jumps = (over_samples(curves, f) for f in (_size_of_jump, _share_of_jumps))
        notes.append(
            f"At {where} λ_min jumps in a share of {all_jumps} of all events; its relative change "
            f"in an event is {size}; before {(changes < -MAX_TREND).sum()} of {len(changes)} "
            f"events it falls by more than 5 %."
        )
    groups = {
        "λ_min of states before events": _measured(trends),
        "λ_min of states before large drops": _measured(jumps),
    }
    return Outcome(groups, " ".join(notes))


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


def _jumps(curve: Curve) -> np.ndarray:
    """Whether λ_min jumps, for every event with an approach of two states."""
    sudden = []
    for first, last in _approaches(curve, 2):
        slope = (curve.lowest_eigenvalue[last] - curve.lowest_eigenvalue[first]) / (
            curve.strain[last] - curve.strain[first]
        )
        change = curve.lowest_eigenvalue[last + 1] - curve.lowest_eigenvalue[last]
        sudden.append(abs(change) > MIN_JUMP_RATIO * abs(slope) * curve.step[last])
    return np.array(sudden, float)


def _share_of_jumps(curve: Curve) -> float:
    known = len(_approaches(curve, 2)) and np.isfinite(curve.lowest_eigenvalue).all()
    return float(_jumps(curve).mean()) if known else np.nan


def _share_of_jumps_in_large_drops(curve: Curve) -> float:
    large = _is_large(curve, _approaches(curve, 2))
    known = large.any() and np.isfinite(curve.lowest_eigenvalue).all()
    return float(_jumps(curve)[large].mean()) if known else np.nan


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
def no_singularity(ensemble) -> Outcome:
    """The rigidity has no singularity -(γ_c - γ)^(-1/2) below γ_c (Fig. 3).

    g of the states before an event is fitted by a + b (γ_c - γ) + A (γ_c - γ)^(-1/2). The measured
    number is the share of the events of a sample in which the last term, at the last of these
    states, is within ±1 % of the mean |g| of the sample; of all events, and of the largest tenth of
    the drops of σ.

    Asked of: every point with events that five states lead up to.

    Criterion: The singular term is within ±1 % of the mean |g| in more than 90 % of the events and
    of the largest drops.
    """
    every, largest, notes = [], [], []
    for where, curves in sheared(ensemble, "curve_g_xy"):
        every.append(Part(f"all events, {where}", over_samples(curves, _regular), MIN_SHARE))
        of_large = over_samples(curves, _regular_in_large_drops)
        largest.append(Part(f"largest drops, {where}", of_large, MIN_SHARE))
        term = over_samples(curves, _mean_singular)
        notes.append(f"At {where} the mean singular term is {term} of the mean |g|.")
    groups = {
        f"events with {MIN_STATES} states before them": _measured(every),
        f"large drops with {MIN_STATES} states before them": _measured(largest),
    }
    return Outcome(groups, " ".join(notes))


def _singular_terms(curve: Curve) -> np.ndarray:
    """The singular term of every event that enough states lead up to, over the mean |g|."""
    terms = [_singular_term(curve, approach) for approach in _approaches(curve, MIN_STATES)]
    return np.array(terms) / np.abs(curve.modulus).mean()


def _mean_singular(curve: Curve) -> float:
    terms = _singular_terms(curve)
    return float(terms.mean()) if len(terms) else np.nan


def _regular(curve: Curve) -> float:
    terms = np.abs(_singular_terms(curve))
    return float((terms < TOLERANCE).mean()) if len(terms) else np.nan


def _regular_in_large_drops(curve: Curve) -> float:
    large = _is_large(curve, _approaches(curve, MIN_STATES))
    if not large.any():
        return np.nan
    return float((np.abs(_singular_terms(curve))[large] < TOLERANCE).mean())


def _singular_term(curve: Curve, approach: Approach) -> float:
    critical = curve.strain[approach.last : approach.last + 2].mean()
    distance = critical - curve.strain[approach.states]
    terms = np.stack([np.ones(len(distance)), distance, distance**-0.5], axis=1)
    scale = np.abs(terms).max(axis=0)
    fit = np.linalg.lstsq(terms / scale, curve.modulus[approach.states], rcond=None)[0]
    return fit[2] * terms[-1, 2] / scale[2]


@claim("B7", unit="1")
def quadrupole_of_rotations(ensemble) -> Outcome:
    """Domains of rotating grains in a large event form a quadrupole (Fig. 6).

    p_m is |Σ Δℓ exp(i m ϑ)|² / (Σ |Δℓ|)² around the grain that moves farthest. It is taken of the
    largest tenth of the drops of σ of every sample; B shows one. It is compared with p_2 after
    permutations of the rotations among the grains, and with the mean of p_1, p_3 and p_4, which
    domains of any other shape raise as well.

    Asked of: every point with events, of N ≥ 1024, as B's Fig. 6.

    Criterion: In more than half of the largest drops p_2 is above that of 95 % of the permutations,
    and on average it exceeds the mean of p_1, p_3 and p_4.
    """
    samples = harmonic(ensemble, "event_quadrupole", "event_quadrupole_rank")
    needs = "" if samples.n >= QUADRUPOLE_N else f"N ≥ {QUADRUPOLE_N}"
    ordered, excess, notes = [], [], []
    for point in samples.points("event_quadrupole"):
        large = _largest_drops(samples, point)
        rank, quadrupole, others = (
            np.where(large, samples.values(name, *point), np.nan) for name in POLE_NAMES
        )
        beyond = np.where(np.isfinite(rank), rank <= MAX_RANK, np.nan)
        where = label(*point)
        ordered.append(Part(f"ordered, {where}", mean(_share(beyond)), 0.5, needs=needs))
        more = mean(_by_sample(quadrupole - others))
        excess.append(Part(f"p_2 - other p_m, {where}", more, 0.0, needs=needs))
        notes.append(
            f"At {where}, N = {samples.n}, p_2 of the largest drops is "
            f"{mean(_by_sample(quadrupole))}; of rotations ∝ cos 2ϑ it is {PURE_QUADRUPOLE:.2f}."
        )
    groups = {"events": _measured(ordered), "large events": _measured(excess)}
    return Outcome(groups, " ".join(notes))


def _largest_drops(samples: Samples, point: tuple[float, float]) -> np.ndarray:
    """Which events are among the largest tenth of the drops of σ of their sample, (S, E) bool."""
    before, after = (samples.values(f"event_stress_{side}", *point) for side in ("before", "after"))
    drop = before - after
    with np.errstate(invalid="ignore"):
        return drop >= np.array([[_quantile(row)] for row in drop])


def _quantile(drops: np.ndarray) -> float:
    known = drops[np.isfinite(drops)]
    return float(np.quantile(known, 1.0 - LARGEST)) if len(known) else np.inf


def _by_sample(values: np.ndarray) -> np.ndarray:
    """Mean over the events of each sample, for samples with events."""
    known = np.isfinite(values).any(axis=1)
    return np.nanmean(values[known], axis=1)


@claim("B14", unit="1")
def jumps_grow_with_strain(ensemble: xr.Dataset) -> Outcome:
    """The jump of the rigidity in an event near γ = 0.001 is smaller than near γ = 0.341 (Fig. 7).

    This is log10 of the mean |Δg| of the events of a sample at γ ≥ 0.25, minus that at γ ≤ 0.05.

    Asked of: every point with events, sheared to γ ≥ 0.34.

    Criterion: The mean |Δg| is larger at γ ≥ 0.25 than at γ ≤ 0.05.
    """
    samples = harmonic(ensemble, "curve_strain", "event_g_before", "event_g_after")
    parts, notes = [], []
    for point in samples.points("event_g_after"):
        before, after, strain = (
            samples.values(f"event_{name}", *point)
            for name in ("g_before", "g_after", "strain_before")
        )
        reached = np.nanmax(samples.values("curve_strain", *point))
        needs = "" if reached >= FAR_STRAIN else f"shear to γ = {FAR_STRAIN}"
        size = np.abs(after - before)
        early, late = (
            _mean_by_row(np.where(range_, size, np.nan))
            for range_ in (strain <= EARLY_EVENTS, strain >= LATE_EVENTS)
        )
        growth = mean(np.log10(late / early))
        parts.append(Part(label(*point), growth, 0.0, needs=needs))
        notes.append(f"At {label(*point)} |Δg| is {mean(early)} early and {mean(late)} late.")
    return Outcome({"events": parts}, " ".join(notes))


def _mean_by_row(values: np.ndarray) -> np.ndarray:
    """Mean of each row, NaN without a number in it."""
    known = np.isfinite(values)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.nansum(values, axis=1) / known.sum(axis=1)


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
