"""Claims of paper A on G(φ, k_T/k_N): A2 to A5.

    symbol        name                   paper A
    G             g                      Eq. 17, theory (Eqs. 39-46)
    phi_c         phi_jamming            of the frictionless packing
    kappa         kt = k_T/k_N

Every comparison is paired: at all k_T the packings of one seed are the same. An average here runs
over jammed samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.paper_a.ranges import (
    LARGE_KAPPA,
    LOG_TOLERANCE,
    MIN_PHI,
    SMALL_KAPPA,
    enough_grains,
)
from grainmodes.claims.part import Part
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled, label
from grainmodes.ensemble.trends import MIN_AREA_FRACTIONS, exponent
from grainmodes.statistics.estimates import (
    Estimate,
    jackknife,
    log_relative_difference,
    mean,
    relative_difference,
)

if TYPE_CHECKING:
    import xarray as xr

LIMIT_TOLERANCE = 0.001
"""Largest relative difference to the frictionless G at which its limit counts as reached."""


@claim("A2", unit="1")
def not_proportional_to_distance(ensemble: xr.Dataset) -> Outcome:
    """G is not proportional to φ - φ_c at large k_T/k_N (Sec. IV A).

    The exponent β of G ∝ (φ - φ_c)^β is the slope of log G of each seed, with φ_c of this seed.
    Samples with G ≤ 0 have no logarithm and are counted.

    Asked of: every k_T/k_N ≥ 1 with three φ.

    Criterion: β differs from 1 by more than 0.1 at every k_T/k_N ≥ 1.
    """
    samples = best_sampled(ensemble, "g", "phi_jamming")
    enough = [k for k in samples.kappas("g") if len(samples.phis("g", k)) >= MIN_AREA_FRACTIONS]
    if not enough:
        raise NotTested(f"{MIN_AREA_FRACTIONS} area fractions with jammed samples")
    exponents = {kappa: exponent(samples.ensemble, samples.n, kappa) for kappa in enough}
    parts = [
        Part(label(kappa=kappa), beta, 0.9, 1.1, outside=True)
        for kappa, beta in exponents.items()
        if kappa >= LARGE_KAPPA
    ]
    listed = ", ".join(f"{beta} at κ = {kappa:g}" for kappa, beta in exponents.items())
    return Outcome({"k_T/k_N ≥ 1": parts}, f"The exponent β is {listed}.")


@claim("A3", unit="1")
def flat_at_small_stiffness(ensemble: xr.Dataset) -> Outcome:
    """G hardly depends on k_T/k_N for k_T/k_N ≤ 1e-4 (Fig. 5).

    This is log10 of the size of the relative difference of G to that at the smallest k_T > 0,
    averaged over the seeds. Near jamming, and in small systems, single packings have a G near 0 or
    below; a mean of the differences themselves would be that of one packing.

    Asked of: two k_T/k_N ≤ 1e-4, at every φ ≥ 0.85, at N ≥ 256.

    Criterion: The geometric mean of the relative difference to G at the smallest k_T > 0 is below
    1 %.
    """
    samples = best_sampled(ensemble, "g")
    parts, errors = [], {}
    for phi in samples.phis("g"):
        kappas = samples.kappas("g", phi, ABOVE_ZERO, SMALL_KAPPA)
        if phi < MIN_PHI or len(kappas) < 2:
            continue
        reference = samples.values("g", phi, kappas[0])
        for kappa in kappas[1:]:
            difference = log_relative_difference(samples.values("g", phi, kappa), reference)
            needs = enough_grains(samples.n)
            parts.append(Part(label(phi, kappa), difference, high=LOG_TOLERANCE, needs=needs))
        errors[phi] = mean(reference).error / np.nanmean(reference)
    listed = ", ".join(f"{error:.2g} at {label(phi)}" for phi, error in errors.items())
    note = f"For comparison, the relative standard error of G itself is {listed}."
    return Outcome({"two k_T/k_N ≤ 1e-4 at φ ≥ 0.85": parts}, note)


@claim("A4", unit="1")
def frictionless_limit(ensemble: xr.Dataset) -> Outcome:
    """G tends to its frictionless value as k_T → 0, without a jump (Sec. IV A).

    This is the relative difference of G at the smallest k_T > 0 and at k_T = 0, paired by seed, at
    every φ.

    Asked of: every φ with k_T = 0 and a k_T/k_N ≤ 1e-6.

    Criterion: The relative difference is within ±0.1 % at the smallest k_T/k_N ≤ 1e-6.
    """
    samples = best_sampled(ensemble, "g")
    with_limit = [
        phi for phi in samples.phis("g", 0.0) if samples.kappas("g", phi, ABOVE_ZERO, 1e-6)
    ]
    if not with_limit:
        raise NotTested("k_T = 0 and a k_T/k_N ≤ 1e-6")
    parts = [
        Part(
            label(phi, kappa),
            _to_frictionless(samples, phi, kappa),
            -LIMIT_TOLERANCE,
            LIMIT_TOLERANCE,
        )
        for phi in with_limit
        for kappa in samples.kappas("g", phi, ABOVE_ZERO, 1e-6)[:1]
    ]
    phi = with_limit[-1]
    approach = {
        k: _to_frictionless(samples, phi, k) for k in samples.kappas("g", phi, ABOVE_ZERO, 1.0)
    }
    listed = ", ".join(f"{value} at κ = {kappa:g}" for kappa, value in approach.items())
    return Outcome(
        {"k_T = 0 and a k_T/k_N ≤ 1e-6": parts}, f"The difference at {label(phi)} is {listed}."
    )


def _to_frictionless(samples: Samples, phi: float, kappa: float) -> Estimate:
    return relative_difference(samples.values("g", phi, kappa), samples.values("g", phi, 0.0))


@claim("A5", unit="1")
def no_factorisation(ensemble: xr.Dataset) -> Outcome:
    """G(φ, k_T/k_N) is not a product G_0(φ) 𝒢(k_T/k_N) at large k_T/k_N (Sec. IV A, footnote 2).

    This is the difference of log[G(κ)/G(0)] between the lowest and the highest φ ≥ 0.85, with
    averages of G over the seeds; for a product it is 0.

    Asked of: every k_T/k_N ≥ 1 with k_T = 0 beside it, at two φ ≥ 0.85.

    Criterion: log[G(κ)/G(0)] differs by more than 0.05 between the lowest and the highest φ,
    at every k_T/k_N ≥ 1.
    """
    samples = best_sampled(ensemble, "g")
    phis = [phi for phi in samples.phis("g", 0.0) if phi >= MIN_PHI]
    if len(phis) < 2:
        raise NotTested("k_T = 0 at two area fractions ≥ 0.85 with jammed samples")
    parts, ends = [], (phis[0], phis[-1])
    for kappa in samples.common_kappas("g", ends, LARGE_KAPPA):
        rows = [samples.values("g", phi, k) for phi in ends for k in (kappa, 0.0)]
        parts.append(Part(label(kappa=kappa), jackknife(_gain_apart, *rows), -0.05, 0.05, True))
    return Outcome({"k_T/k_N ≥ 1 at two area fractions": parts}, _gains(samples, ends))


def _gain_apart(low: np.ndarray, low_0: np.ndarray, high: np.ndarray, high_0: np.ndarray) -> float:
    """log of <G(κ)>/<G(0)> at the lowest φ over that at the highest."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return float(np.log(low.mean() / low_0.mean() / (high.mean() / high_0.mean())))


def _gains(samples: Samples, phis: tuple[float, float]) -> str:
    """G(κ)/G(0) at the largest κ, at two area fractions."""
    kappa = samples.kappas("g", phis[-1])[-1]
    gains = {phi: _to_frictionless(samples, phi, kappa) for phi in phis}
    listed = (f"{g._replace(value=g.value + 1)} at {label(phi)}" for phi, g in gains.items())
    return f"G(κ = {kappa:g}) / G(0) is {' and '.join(listed)}."
