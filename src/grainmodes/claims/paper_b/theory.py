"""Claims of paper B on theory and simulation: B1, B8 and B10.

    symbol       name                                                       paper B
    σ            Curve.stress                                               Eq. 15
    g            Curve.modulus, linear response                             Eqs. 42-44
    σ_th         σ + g Δγ of the step before                                Eq. 51
    G_0          g, and g_simulated, before any strain                      App. E 2

Numbers are taken from each curve first; their mean and its error are those over the samples.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_b.sheared import TOLERANCE, harmonic, over_samples, sheared
from grainmodes.claims.part import Part
from grainmodes.claims.samples import label
from grainmodes.ensemble.curves import Curve, even_bins
from grainmodes.statistics.estimates import Estimate, complete, mean, relative_difference

N_BINS = 10
"""Number of bins of strain in which mean rigidities are compared."""

RIGIDITY_TOLERANCE = 0.05
"""Relative difference of two mean rigidities that exceeds the error bars of B, Fig. 9."""

MIN_DECADES = 1.0
"""Smallest range of log10 Δγ for a fit of an order."""


@claim("B1", unit="1")
def theory_is_simulation(ensemble) -> Outcome:
    """σ_th(γ + Δγ) = σ + g Δγ equals the simulated stress, except in events (Figs. 1, 8).

    Three numbers are taken from every sample: the root mean square of σ - σ_th over the steps
    without an event, over that of σ; the sum of |σ - σ_th| over the steps in which no contact
    changed, over that of |g Δγ|; and the order of |σ - σ_th| in Δγ, if steps of several sizes
    precede an event.

    Asked of: every point with sheared samples; the order, where steps of several sizes precede an
    event.

    Criterion: σ - σ_th is below 1 % of σ, and below 1 % of g Δγ in steps without a change of
    contacts; its order in Δγ lies within 1.8 ... 2.2.
    """
    parts, notes = [], []
    for where, curves in sheared(ensemble, "curve_g_xy"):
        of_stress = over_samples(curves, _deviation_of_stress)
        in_quiet_steps = over_samples(curves, _deviation_in_quiet_steps)
        parts.append(Part(f"σ, {where}", of_stress, high=TOLERANCE))
        parts.append(Part(f"quiet steps, {where}", in_quiet_steps, high=TOLERANCE))
        order = over_samples(curves, _order)
        if np.isfinite(order.value):
            parts.append(Part(f"order, {where}", order, 1.8, 2.2))
        changed = over_samples(curves, _share_of_changed_steps)
        if changed.value > 0.0:
            deviation = over_samples(curves, _deviation_in_changed_steps)
            notes.append(
                f"In {100.0 * changed.value:.2g} % of the steps without an event at {where} "
                f"contacts open, close or release their spring. In these steps |σ - σ_th| is "
                f"{deviation} of |g Δγ|."
            )
    return Outcome({"sheared samples": parts}, " ".join(notes))


def _deviation_of_stress(curve: Curve) -> float:
    deviation = curve.deviation[~curve.event]
    return np.sqrt((deviation**2).mean() / (curve.stress**2).mean())


def _deviation_in_quiet_steps(curve: Curve) -> float:
    return _relative(curve, curve.quiet)


def _deviation_in_changed_steps(curve: Curve) -> float:
    return _relative(curve, curve.changed & ~curve.event)


def _share_of_changed_steps(curve: Curve) -> float:
    return (curve.changed & ~curve.event).sum() / (~curve.event).sum()


def _relative(curve: Curve, steps: np.ndarray) -> float:
    return np.abs(curve.deviation[steps]).sum() / np.abs(curve.predicted_change[steps]).sum()


def _order(curve: Curve) -> float:
    """Mean over the events of d log|σ - σ_th| / d log Δγ before them, for steps above round-off."""
    smallest = 5.0 * curve.step.min(initial=np.inf)
    slopes = []
    for first, last in curve.approaches:
        step, deviation = curve.step[first:last], np.abs(curve.deviation[first:last])
        used = (step > smallest) & (deviation > 0.0)
        x, y = np.log10(step[used]), np.log10(deviation[used])
        if used.sum() > 2 and np.ptp(x) >= MIN_DECADES:
            slopes.append(np.polyfit(x, y, 1)[0])
    return np.mean(slopes) if slopes else np.nan


@claim("B8", unit="1")
def mean_rigidity(ensemble) -> Outcome:
    """The mean rigidity G(γ) of the theory equals that of the simulation (Fig. 9).

    This is the relative difference of the mean of Δσ/Δγ and the mean of g, paired by sample, over
    the steps without an event in every tenth of the strain.

    Asked of: every point with sheared samples, in every tenth of their strain.

    Criterion: The relative difference of the two is within ±5 % in every tenth of the strain.
    """
    parts, notes = [], []
    for where, curves in sheared(ensemble, "curve_g_xy"):
        edges = even_bins(curves, N_BINS)
        theory = np.array([curve.mean_slopes(curve.predicted_change, edges) for curve in curves])
        simulation = np.array([curve.mean_slopes(curve.stress_change, edges) for curve in curves])
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
            f"Over all strains at {where} the difference is {whole}; G is "
            f"{first} in the first tenth and {final} in the last."
        )
    return Outcome({"sheared samples": parts}, " ".join(notes))


@claim("B10", unit="1")
def rigidity_before_strain(ensemble) -> Outcome:
    """The rigidity G_0(φ, k_T/k_N) before any strain equals that of the simulation (Fig. 16).

    This is the relative difference of g_simulated and g, paired by seed, at every point.

    Asked of: every point with a simulated rigidity.

    Criterion: The relative difference of the two is within ±1 % at every point.
    """
    samples = harmonic(ensemble, "g", "g_simulated")
    parts = [
        Part(label(*point), _difference(samples, point), -TOLERANCE, TOLERANCE)
        for point in _points(samples)
    ]
    return Outcome({"g and g_simulated at one point": parts})


def _points(samples) -> list[tuple[float, float]]:
    theory = samples.points("g")
    return [point for point in samples.points("g_simulated") if point in theory]


def _difference(samples, point: tuple[float, float]) -> Estimate:
    return relative_difference(*(samples.values(name, *point) for name in ("g_simulated", "g")))
