"""Claims of paper B on theory and simulation: B1, B8 and B10.

    symbol       name                                                       paper B
    σ            Curve.stress                                               Eq. 15
    g            Curve.modulus, linear response                             Eqs. 42-44
    σ_th         σ + g Δγ of the step before                                Eq. 51
    G_0          g, and g_simulated, before any strain                      App. E 2

Numbers of one curve first, their mean and its error over the samples then.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from grainmodes.claims.claim import NotTested, Outcome, Part, claim
from grainmodes.claims.paper_b.sheared import TOLERANCE, harmonic, over_samples, sheared
from grainmodes.claims.samples import label
from grainmodes.ensemble.curves import Curve, even_bins
from grainmodes.statistics.estimates import Estimate, complete, mean, relative_difference

N_BINS = 10
"""Parts of the whole strain in which mean rigidities are compared."""

RIGIDITY_TOLERANCE = 0.05
"""Relative difference of two mean rigidities that stands out of the error bars of B, Fig. 9."""

MIN_DECADES = 1.0
"""Range of log10 Δγ without which no order is fitted."""


@claim("B1", unit="1")
def theory_is_simulation(ensemble) -> Outcome:
    """σ_th(γ + Δγ) = σ + g Δγ is the simulated stress at every strain, events apart (Figs. 1, 8).

    Of every sample: over the steps without an event the root mean square of σ - σ_th over that of
    σ; over those in which also no contact changed the sum of |σ - σ_th| over that of |g Δγ|; and
    where steps of several sizes lead up to an event, the order of |σ - σ_th| in Δγ.

    Criterion: both below 1 %, the order within 1.8 ... 2.2.
    """
    parts, notes = [], []
    for where, of in sheared(ensemble, "curve_g_xy"):
        parts.append(Part(f"σ, {where}", over_samples(of, _of_stress), high=TOLERANCE))
        parts.append(
            Part(f"quiet steps, {where}", over_samples(of, _of_quiet_steps), high=TOLERANCE)
        )
        order = over_samples(of, _order)
        if np.isfinite(order.value):
            parts.append(Part(f"order, {where}", order, 1.8, 2.2))
        loud = over_samples(of, lambda curve: _loud(curve).sum() / (~curve.event).sum())
        if loud.value > 0.0:
            off = over_samples(of, _of_changed_steps)
            notes.append(
                f"In {100.0 * loud.value:.2g} % of the steps without an event at {where} contacts "
                f"open, close or let go of their spring; there the step is off by {off} of "
                "its size."
            )
    return Outcome(parts, " ".join(notes))


def _of_stress(curve: Curve) -> float:
    missing = curve.deviation[~curve.event]
    return np.sqrt((missing**2).mean() / (curve.stress**2).mean())


def _of_quiet_steps(curve: Curve) -> float:
    return _relative(curve, curve.quiet)


def _of_changed_steps(curve: Curve) -> float:
    return _relative(curve, _loud(curve))


def _loud(curve: Curve) -> np.ndarray:
    return curve.changed & ~curve.event


def _relative(curve: Curve, steps: np.ndarray) -> float:
    return np.abs(curve.deviation[steps]).sum() / np.abs(curve.predicted_change[steps]).sum()


def _order(curve: Curve) -> float:
    """Mean over the events of d log|σ - σ_th| / d log Δγ on their approaches, above round-off."""
    above = 5.0 * curve.step.min(initial=np.inf)
    slopes = []
    for first, last in curve.approaches:
        step, missing = curve.step[first:last], np.abs(curve.deviation[first:last])
        used = (step > above) & (missing > 0.0)
        x, y = np.log10(step[used]), np.log10(missing[used])
        if used.sum() > 2 and np.ptp(x) >= MIN_DECADES:
            slopes.append(np.polyfit(x, y, 1)[0])
    return np.mean(slopes) if slopes else np.nan


@claim("B8", unit="1")
def mean_rigidity(ensemble) -> Outcome:
    """The mean rigidity G(γ) of the theory is that of the simulation (Fig. 9).

    Relative difference of the mean of Δσ/Δγ and the mean of g, paired by sample, over the steps
    without an event in every tenth of the strain.

    Criterion: |difference| < 5 % in every tenth.
    """
    parts, notes = [], []
    for where, of in sheared(ensemble, "curve_g_xy"):
        edges = even_bins(of, N_BINS)
        theory = np.array([curve.mean_slopes(curve.predicted_change, edges) for curve in of])
        simulation = np.array([curve.mean_slopes(curve.stress_change, edges) for curve in of])
        for bin_, (low, high) in enumerate(pairwise(edges)):
            difference = relative_difference(simulation[:, bin_], theory[:, bin_])
            parts.append(
                Part(
                    f"γ = {low:.3g} ... {high:.3g}, {where}",
                    difference,
                    -RIGIDITY_TOLERANCE,
                    RIGIDITY_TOLERANCE,
                )
            )
        whole = relative_difference(simulation.mean(axis=1), theory.mean(axis=1))
        first, final = (mean(theory[complete(theory), place]) for place in (0, -1))
        notes.append(
            f"Over all strains at {where} the difference is {whole}; G goes from "
            f"{first} in the first tenth to {final} in the last."
        )
    return Outcome(parts, " ".join(notes))


@claim("B10", unit="1")
def rigidity_before_strain(ensemble) -> Outcome:
    """The rigidity G_0(φ, k_T/k_N) before any strain is that of the simulation (Fig. 16).

    Relative difference of g_simulated and g, paired by seed, at every point.

    Criterion: |G_simulated - G_0| < 1 % of G_0.
    """
    samples = harmonic(ensemble, "g", "g_simulated")
    parts = [
        Part(label(*point), _difference(samples, point), -TOLERANCE, TOLERANCE)
        for point in _points(samples)
    ]
    if not parts:
        raise NotTested("g and g_simulated at one point")
    return Outcome(parts)


def _points(samples) -> list[tuple[float, float]]:
    theory = samples.points("g")
    return [point for point in samples.points("g_simulated") if point in theory]


def _difference(samples, point: tuple[float, float]) -> Estimate:
    return relative_difference(*(samples.values(name, *point) for name in ("g_simulated", "g")))
