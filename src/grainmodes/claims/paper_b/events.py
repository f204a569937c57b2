"""Claims of paper B on plastic events themselves: B7, B9 and B14.

Shares are those of all events, judged by the number of events and of samples (`PooledShare`).
Averages run over the events of each sample first, and then over the samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_b.sheared import (
    MIN_SHARE,
    harmonic,
    large_drop,
    measured,
)
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, label
from grainmodes.statistics.estimates import mean
from grainmodes.statistics.shares import pooled_share

if TYPE_CHECKING:
    import xarray as xr

POLE_NAMES = ("event_quadrupole_rank", "event_quadrupole", "event_other_multipoles")

HALF = 0.5

MAX_RANK = 0.05
"""Rank of p_2 among permutations up to which the rotations are not at random."""

QUADRUPOLE_N = 1024
"""N of B, Figs. 4 to 6: four domains need room."""

EARLY_EVENTS, LATE_EVENTS, FAR_STRAIN = 0.05, 0.25, 0.34
"""Strains up to which events are early, and from which they are late; that of B, Fig. 3."""

PURE_QUADRUPOLE = 0.617
"""p_2 of rotations proportional to cos 2ϑ: (π/4)²."""


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
        ordered.append(Part(f"ordered, {where}", pooled_share(beyond), HALF, needs=needs))
        more = mean(_by_sample(quadrupole - others))
        excess.append(Part(f"p_2 - other p_m, {where}", more, 0.0, needs=needs))
        notes.append(
            f"At {where}, N = {samples.n}, p_2 of the largest drops is "
            f"{mean(_by_sample(quadrupole))}; of rotations ∝ cos 2ϑ it is {PURE_QUADRUPOLE:.2f}."
        )
    groups = {"events": measured(ordered), "large events": measured(excess)}
    return Outcome(groups, " ".join(notes))


def _largest_drops(samples: Samples, point: tuple[float, float]) -> np.ndarray:
    """Which events are among the largest tenth of the drops of σ of their sample, (S, E) bool."""
    before, after = (samples.values(f"event_stress_{side}", *point) for side in ("before", "after"))
    drop = before - after
    with np.errstate(invalid="ignore"):
        return drop >= np.array([[large_drop(row)] for row in drop])


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
        parts.append(Part(label(*point), pooled_share(changed), MIN_SHARE))
        opened, closed, again = (int(counts[happened].sum()) for counts in changes)
        notes.append(
            f"In {happened.sum()} events at {label(*point)} {opened} contacts opened, "
            f"{closed} closed and {again} did both; the network is the same before and "
            f"after in {pooled_share(1.0 - lasting)}."
        )
    return Outcome({"events": measured(parts)}, " ".join(notes))
