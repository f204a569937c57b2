"""Claims of paper B on its methods: B2, B5, B6 and B11 to B13.

symbol          name                                              paper B
|J - Jᵀ|        event_asymmetry_after, over max|J|                App. C 2, D 3
complex pairs   event_complex_pairs_after, of M⁻¹J                Sec. III A: there are none
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_b.sheared import TOLERANCE, harmonic
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, label
from grainmodes.statistics.estimates import mean
from grainmodes.statistics.medians import median

if TYPE_CHECKING:
    import xarray as xr

MAX_LOG_ASYMMETRY = -12.0
"""log10 of max|J - Jᵀ| / max|J| below which an asymmetry is round-off."""

MAX_LOG_ERR = -15.5
"""log10 of B's bound 3e-16 on Err."""

MAX_LOG_LEFT = -3.0
"""log10 of the part of s that a loop may leave: the square of a step of 1e-4 is far below it."""

COARSE_NAMES = ("coarse_strain", "coarse_stress")

STRAIN_RANGES = (
    ("γ ≤ 0.08", 0.0, 0.08, (-np.inf, TOLERANCE)),
    ("γ > 0.08", 0.08, np.inf, (TOLERANCE, np.inf)),
)
"""Name, ends of the range of strain, and the interval of the difference expected there."""

FAR_STRAIN = 0.34
"""Strain to which a shear must go for the claim on large strains: B goes to 0.5."""

STRAIN_TOLERANCE = 1e-12
"""Largest difference of two strains that count as equal."""

SMALLEST_ASYMMETRY = 1e-17
"""Relative asymmetry that replaces 0, which has no logarithm."""

BRACKET_NAMES = ("min_step", "strain_before", "strain_after")

MAX_CONVERGED_STEP = 1.1e-6
"""Largest Δγ_Th at which γ_c has converged: 1e-6, with a margin for round-off."""


@claim("B2", unit="1")
def independent_of_min_step(ensemble) -> Outcome:
    """The stress does not depend on Δγ_Th up to γ = 0.08, and depends on it above (Fig. 2).

    This is the root mean square of the difference of σ with and without bracketed events, over the
    root mean square of σ.

    Asked of: every point with sheared samples; strains up to γ = 0.08 and beyond.

    Criterion: The relative difference of σ with and without brackets is below 1 % up to γ = 0.08,
    and above 1 % beyond.
    """
    samples = harmonic(ensemble, "curve_strain", "coarse_strain")
    parts = []
    for point in samples.points("coarse_strain"):
        reached = np.nanmax(samples.values("coarse_strain", *point))
        needs = "" if reached >= FAR_STRAIN else f"shear to γ = {FAR_STRAIN}"
        names = ("curve_strain", "curve_stress_xy", "curve_stress_yx")
        curves = [samples.values(name, *point) for name in (*names, *COARSE_NAMES)]
        for where, low, high, interval in STRAIN_RANGES:
            off = np.array([_apart(*rows, low, high) for rows in zip(*curves, strict=True)])
            if np.isfinite(off).any():
                difference = mean(off[np.isfinite(off)])
                needed = needs if low > 0.0 else ""
                parts.append(Part(f"{where}, {label(*point)}", difference, *interval, needs=needed))
    return Outcome({"sheared samples with and without brackets": parts})


def _apart(strain, stress_xy, stress_yx, coarse_strain, coarse_stress, low, high) -> float:
    """Relative difference of two curves on the grid of Δγ_in in (low, high]; NaN if it is empty."""
    grid = (coarse_strain > low + STRAIN_TOLERANCE) & (coarse_strain < high + STRAIN_TOLERANCE)
    if not grid.any():
        return np.nan
    place = np.searchsorted(strain, coarse_strain[grid] - STRAIN_TOLERANCE)
    fine = 0.5 * (stress_xy + stress_yx)[np.minimum(place, len(strain) - 1)]
    with np.errstate(invalid="ignore"):
        return float(np.sqrt(np.nanmean((fine - coarse_stress[grid]) ** 2) / np.nanmean(fine**2)))


@claim("B5", unit="1")
def critical_strain_converges(ensemble) -> Outcome:
    """The strain γ_c of an event converges for Δγ_Th ≤ 1e-6 (App. B, Fig. 12).

    This is the distance, in units of Δγ_Th, of γ_c from that of the narrowest bracket, for the
    first event of every sample.

    Asked of: the first event of every sample, at every Δγ_Th ≤ 1e-6 but the smallest.

    Criterion: γ_c is on average within Δγ_Th of its value in the narrowest bracket, at every
    Δγ_Th ≤ 1e-6.
    """
    samples = harmonic(ensemble, "bracket_min_step")
    parts = []
    for point in samples.points("bracket_strain_after"):
        width, before, after = (samples.values(f"bracket_{name}", *point) for name in BRACKET_NAMES)
        critical = 0.5 * (before + after)
        off = np.abs(critical - critical[:, -1:]) / width
        widths = np.nanmax(width, axis=0)
        for column in np.flatnonzero(widths[:-1] < MAX_CONVERGED_STEP):
            known = off[np.isfinite(off[:, column]), column]
            where = f"Δγ_Th = {widths[column]:.0e}, {label(*point)}"
            parts.append(Part(where, mean(known), high=1.0))
    return Outcome({"events with brackets of 1e-6 or less": parts})


@claim("B6", unit="1")
def tangential_integral(ensemble: xr.Dataset) -> Outcome:
    """The integral of the tangential velocity of a contact stays tangential (App. A, Fig. 10).

    This is log10 of the largest Err of (A1) among the contacts, in the last state before the first
    event. The velocities are summed as vectors, as in Eq. (10), along the turning contact.

    Asked of: every point with states before the first event.

    Criterion: log10 of the largest Err is below -15.5, that is Err < 3e-16.
    """
    samples = harmonic(ensemble, "last_path_error", "last_path_increment")
    parts, notes = [], []
    for point in samples.points("last_path_error"):
        largest, increment, turn = (
            samples.values(f"last_path_{name}", *point) for name in ("error", "increment", "turn")
        )
        where = label(*point)
        parts.append(Part(where, mean(np.log10(largest)), high=MAX_LOG_ERR))
        notes.append(
            f"At {where} log10 of Err of a single step, against the normal in its middle, is "
            f"{mean(np.log10(increment))}, and the contacts have turned by {mean(turn)} in the "
            "median."
        )
    return Outcome({"states before the first event": parts}, " ".join(notes))


@claim("B11", unit="1")
def symmetric_jacobian(ensemble: xr.Dataset) -> Outcome:
    """The Jacobian is symmetric at any strain (App. C 2, D 3).

    This is log10 of max|J - Jᵀ| / max|J| of the state after an event, averaged over events.

    Asked of: every point with events.

    Criterion: log10 of max|J - Jᵀ| / max|J| is below -12 after events.
    """
    samples = harmonic(ensemble, "event_asymmetry_after")
    parts, notes = [], []
    for point in samples.points("event_asymmetry_after"):
        by_event = np.log10(
            np.maximum(samples.values("event_asymmetry_after", *point), SMALLEST_ASYMMETRY)
        )
        known = np.isfinite(by_event).any(axis=1)
        parts.append(
            Part(label(*point), mean(np.nanmean(by_event[known], axis=1)), high=MAX_LOG_ASYMMETRY)
        )
        notes.append(_pairs(samples, point))
    return Outcome({"events": parts}, " ".join(notes))


@claim("B12", unit="1")
def rate_after_event(ensemble: xr.Dataset) -> Outcome:
    """dq̊/dγ of linear response just after an event is that of the simulation (Fig. 5).

    This is |simulation - theory| / |theory| of the field of all grains after the first event of
    every sample, from a step of 1e-8.

    Asked of: the first event of every sample.

    Criterion: The relative difference of the two fields is below 1 %.
    """
    samples = harmonic(ensemble, "rate_difference")
    parts = []
    for point in samples.points("rate_difference"):
        found = samples.values("rate_difference", *point)
        parts.append(Part(label(*point), median(found[np.isfinite(found)]), high=TOLERANCE))
    return Outcome({"events": parts})


@claim("B13", unit="1")
def springs_without_history(ensemble: xr.Dataset) -> Outcome:
    """The tangential force has no history: a closed loop of strain brings s back (Sec. V).

    A shear goes half as far as no contact changes, for ten steps at most, and back. This is log10
    of the largest |Δs| after the loop over the largest |Δs| at its far end; median over samples.

    Asked of: every point with sheared samples.

    Criterion: log10 of the part of s that is left is below -3.
    """
    samples = harmonic(ensemble, "loop_left", "loop_slide")
    parts, notes = [], []
    for point in samples.points("loop_left"):
        left, slide, strain = (
            samples.values(f"loop_{name}", *point) for name in ("left", "slide", "strain")
        )
        moved = slide > 0.0
        part = np.log10(np.maximum(left[moved] / slide[moved], SMALLEST_ASYMMETRY))
        parts.append(Part(label(*point), median(part), high=MAX_LOG_LEFT))
        notes.append(
            f"At {label(*point)} the loops reach γ = {mean(strain[moved])}; in "
            f"{(part > MAX_LOG_LEFT).sum()} of {len(part)} more is left."
        )
    return Outcome({"loops without a change of contacts": parts}, " ".join(notes))


def _pairs(samples: Samples, point: tuple[float, float]) -> str:
    """A sentence on the states with complex pairs after events and at the last strain."""
    sentences = []
    for states, name in (
        ("states after events", "event_complex_pairs_after"),
        ("last states", "last_complex_pairs"),
    ):
        if name in samples.ensemble:
            pairs = samples.values(name, *point)
            known = np.isfinite(pairs)
            sentences.append(f"{(pairs[known] > 0).sum()} of {known.sum()} {states}")
    return f"M⁻¹J has complex pairs in {' and '.join(sentences)} at {label(*point)}." * bool(
        sentences
    )
