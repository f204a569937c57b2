"""Own claims on the rigidity: G1, G2 and G4.

    symbol        name                   source
    G_NA          g_nonaffine            A (41), unloaded step
    g_NA          g_nonaffine_loaded     the same with the tangential springs loaded
    kappa*        ensemble.trends        k_T/k_N at which the mean of G_NA rises through 0
    beta          ensemble.trends        G ∝ (φ - φ_J)^β

A contact of exponent 3/2 (Hertz) stiffens as f_N' = 3/2 f_N/ξ, one of exponent 1 (harmonic) as
f_N' = f_N/ξ: κ* is compared in units of f_N' ξ / f_N, 3/2 or 1.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.part import MIN_SAMPLES, Part
from grainmodes.claims.samples import ABOVE_ZERO, best_sampled, label
from grainmodes.ensemble import normal_law
from grainmodes.ensemble.trends import (
    MIN_AREA_FRACTIONS,
    crossing_samples,
    exponent,
    exponent_between,
    exponents,
    sign_changes,
)
from grainmodes.statistics.estimates import crossing, jackknife, mean

if TYPE_CHECKING:
    import xarray as xr

NORMAL_EXPONENT = {"hertz": 1.5, "harmonic": 1.0}
"""f_N' ξ / f_N of a normal law."""

MIN_PHI = 0.85
"""φ below which G_NA of single packings is 0 or of either sign."""

SCALED_RANGE = (1.0, 2.0)
"""κ* in units of f_N' ξ / f_N, at every φ ≥ 0.85."""

EXPONENT_RANGE = (0.5, 0.9)
"""From the exponent 1/2 of the stiffness of a Hertzian contact to 0.1 below 1, that of G without
friction: closer to 1 they are not told apart, as in claim A2."""

LARGE_KAPPA = 1.0
"""k_T/k_N from which on friction is strong."""


@claim("G1", unit="1")
def sign_change_falls_with_density(ensemble: xr.Dataset) -> Outcome:
    """The unloaded G_NA changes sign at a κ* that falls with φ and follows f_N' ξ/f_N of the law.

    The figure is `nonaffine_crossing`. A finds κ* = 2 on a grid of 1, 2 and 5. κ* is interpolated
    linearly in log k_T, with its error from the jackknife over seeds; its fall is paired by seed.

    Asked of: every φ ≥ 0.85 with k_T on both sides of κ*, at least two of them.

    Criterion: κ* is larger at the lowest φ ≥ 0.85 than at the highest, and κ* / (f_N' ξ/f_N) lies
    within 1.0 ... 2.0.
    """
    samples = best_sampled(ensemble, "g_nonaffine")
    found = sign_changes(ensemble, samples.n, MIN_SAMPLES)
    scale = NORMAL_EXPONENT[normal_law(ensemble)]
    dense = {phi: zero for phi, zero in found.items() if phi >= MIN_PHI}
    scaled = [
        Part(
            f"κ* / {scale:g}, N = {samples.n}, {label(phi)}",
            zero._replace(value=zero.value / scale, error=zero.error / scale),
            *SCALED_RANGE,
        )
        for phi, zero in dense.items()
    ]
    fall = [_fall(ensemble, samples.n, min(dense), max(dense))] if len(dense) > 1 else []
    listed = ", ".join(f"{zero} at {label(phi)}" for phi, zero in found.items())
    note = f"κ* is {listed}." if found else ""
    return Outcome({"k_T on both sides of κ*": scaled, "κ* at two φ ≥ 0.85": fall}, note)


def _fall(ensemble: xr.Dataset, n: int, low: float, high: float) -> Part:
    """κ* at the lowest φ minus that at the highest, samples of one seed taken together."""
    (kappas, rows), (others, other_rows) = (crossing_samples(ensemble, n, p) for p in (low, high))

    def apart(first: np.ndarray, last: np.ndarray) -> float:
        return _zero(kappas, first) - _zero(others, last)

    where = f"κ* at {label(low)} minus that at {label(high)}"
    return Part(where, jackknife(apart, rows, other_rows), low=0.0)


def _zero(kappas: np.ndarray, rows: np.ndarray) -> float:
    return crossing(kappas, rows).value


@claim("G2", unit="k_N d^(1/2)")
def loaded_step_only_softens(ensemble: xr.Dataset) -> Outcome:
    """A step that loads the tangential springs has G_NA ≤ 0 at every k_T: it answers A's question.

    The figure is `g_nonaffine` (b). A cannot explain a G_NA above 0. With loaded springs
    g_NA = -aᵀJ⁺a/L², which no J that is positive lets rise above 0: the positive G_NA is due to
    springs that the affine step leaves unloaded and the relaxation loads.

    Asked of: every point with k_T > 0, among them k_T/k_N ≥ 5, where A finds an unloaded G_NA > 0.

    Criterion: The mean of the loaded G_NA is below 0 at every point.
    """
    samples = best_sampled(ensemble, "g_nonaffine_loaded")
    points = samples.points("g_nonaffine_loaded", ABOVE_ZERO)
    rows = {point: samples.values("g_nonaffine_loaded", *point) for point in points}
    strong = samples.points("g_nonaffine_loaded", 5.0)
    parts = {point: Part(label(*point), mean(row), high=0.0) for point, row in rows.items()}
    groups = {
        "k_T/k_N between 0 and 5": [parts[point] for point in points if point not in strong],
        "k_T/k_N ≥ 5": [parts[point] for point in strong],
    }
    positive = sum(int((row > 0.0).sum()) for row in rows.values())
    known = sum(int(np.isfinite(row).sum()) for row in rows.values())
    return Outcome(groups, f"The loaded G_NA is positive in {positive} of {known} samples.")


@claim("G4", unit="1")
def exponent_of_strong_friction(ensemble: xr.Dataset) -> Outcome:
    """With strong friction G ∝ (φ - φ_J)^β with one β, between 1/2 and 1, at every k_T/k_N ≥ 1.

    The figure is `rigidity_exponent`. β is the slope of log G of each seed, with φ_J of this seed.
    Samples with G ≤ 0 have no logarithm and are counted.

    Asked of: every k_T/k_N ≥ 1 with three φ, at least two of them; Hertzian grains.

    Criterion: β lies within 0.5 ... 0.9, and its difference between the smallest and the largest
    k_T/k_N ≥ 1, paired by seed, within ±0.05.
    """
    if normal_law(ensemble) != "hertz":
        raise NotTested("Hertzian grains")
    samples = best_sampled(ensemble, "g", "phi_jamming")
    kappas = [
        kappa
        for kappa in samples.kappas("g", low=LARGE_KAPPA)
        if len(samples.phis("g", kappa)) >= MIN_AREA_FRACTIONS
    ]
    values = {kappa: exponent(ensemble, samples.n, kappa) for kappa in kappas}
    parts = [Part(label(kappa=k), beta, *EXPONENT_RANGE) for k, beta in values.items()]
    same = []
    if len(kappas) > 1:
        first, last = (exponents(ensemble, samples.n, k)[0] for k in (kappas[0], kappas[-1]))
        where = f"β at κ = {kappas[-1]:g} minus that at {kappas[0]:g}"
        same = [Part(where, mean(last - first), -0.05, 0.05)]
    listed = ", ".join(f"{beta} at κ = {kappa:g}" for kappa, beta in values.items())
    groups = {"k_T/k_N ≥ 1 at three φ": parts, "two k_T/k_N ≥ 1 at three φ": same}
    if not kappas:
        return Outcome(groups)
    phis = samples.phis("g", kappas[-1])
    slopes = [
        f"{exponent_between(ensemble, samples.n, kappas[-1], *pair)} between φ = {pair[0]:g} and "
        f"{pair[1]:g}"
        for pair in (phis[:2], phis[-2:])
    ]
    note = f"β is {listed}. At {label(kappa=kappas[-1])} the slope is {' and '.join(slopes)}."
    return Outcome(groups, note)
