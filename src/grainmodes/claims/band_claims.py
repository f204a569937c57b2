"""Claims of paper A on the rotational and the translational band: A7 to A11.

    symbol    name                                          paper A
    omega     frequency = eigenvalue^(1/2)                  Sec. III A
    psi^R     psi_rotational; rotational: psi^R > 1/2       Eq. 50
    omega_R   (k_T/k_N)^(1/2) / t_0                         Sec. IV B
    kappa     kt = k_T/k_N
    Region I  rotational band, omega < 2 omega_R (the upper end of A's window of bins)
    Region II translational band, omega > 2 omega_R

A shows spectra at φ = 0.90, its largest: here it is the largest φ of the ensemble. Positions are
measured in each sample, and their means and errors are those over the samples.
"""

from __future__ import annotations

import numpy as np

from grainmodes import statistics
from grainmodes.claims.bands import (
    SEPARABLE,
    Modes,
    frictionless,
    mean_in,
    modes,
    per_sample,
    separable,
)
from grainmodes.claims.claim import NotAsked, Outcome, Part, claim, every, text
from grainmodes.claims.estimates import Estimate, jackknife, mean, relative_difference
from grainmodes.claims.samples import TINY, Samples, at, richest

REGION = 2.0
"""omega / omega_R between Regions I and II."""

PURE = 0.9
"""psi above which a region counts as purely rotational or translational."""

SEPARATE, OVERLAP, MERGED = (1e-10, 1e-8), (1e-6, 1e-2), (1.0, np.inf)
"""k_T/k_N of A's three kinds of spectrum (Sec. IV B)."""

SCALING = 0.01
"""Largest k_T/k_N for which A finds omega_R D to collapse."""

WINDOW = np.linspace(0.1, 1.0, 10)
"""Edges in omega / omega_R of the bins in which curves are compared (A, Fig. 10)."""

SMOOTHING = 0.1
"""Width in omega / omega_R of the Gaussian that smooths D before its peak is sought."""

LIMIT = 1e-8
"""k_T/k_N whose translational band A compares with frictionless grains (Fig. 11)."""


def _spectra(ensemble) -> tuple[Samples, float, dict[float, Modes]]:
    """The N with most spectra, its largest φ, and the modes of every k_T > 0 there."""
    samples = richest(separable(ensemble), SEPARABLE)
    phi = samples.phis(SEPARABLE)[-1]
    kappas = samples.kappas(SEPARABLE, phi, TINY)
    return samples, phi, {kappa: modes(samples, phi, kappa) for kappa in kappas}


def _within(spectra: dict[float, Modes], low: float, high: float) -> dict[float, Modes]:
    return {k: of for k, of in spectra.items() if low * 0.999 <= k <= high * 1.001}


@claim("A7", unit="1")
def pure_regions(ensemble) -> Outcome:
    """Modes of Region I are rotational for k_T/k_N ≤ 1e-4, of Region II translational below 1.

    Mean of ψ^R over the modes with ω < 2 ω_R, and of ψ^T over those with ω > 2 ω_R.

    Criterion: each mean is above 0.9.
    """
    _, phi, spectra = _spectra(ensemble)
    parts = [
        Part(f"ψ^R in I at {at(phi, kappa)}", _purity(of, kappa, rotational=True), PURE)
        for kappa, of in _within(spectra, TINY, 1e-4).items()
    ]
    parts += [
        Part(f"ψ^T in II at {at(phi, kappa)}", _purity(of, kappa, rotational=False), PURE)
        for kappa, of in _within(spectra, TINY, 0.5).items()
    ]
    return Outcome(parts)


def _purity(of: Modes, kappa: float, rotational: bool) -> Estimate:
    region = REGION * np.sqrt(kappa)
    if rotational:
        return mean_in(of.psi_rotational, of.frequency < region)
    return mean_in(1.0 - of.psi_rotational, of.frequency > region)


@claim("A8", unit="1")
def gap_overlap_merger(ensemble) -> Outcome:
    """The bands are separate for k_T/k_N in 1e-10 ... 1e-8, overlap in 1e-6 ... 1e-2, merge from 1.

    log10 of the lowest translational ω over the highest rotational ω of a sample: the gap in
    decades, negative where the bands overlap; from k_T/k_N = 1 on the share of rotational modes
    above the lowest translational one.

    Criterion: gap > 0 up to 1e-8, gap < 0 in 1e-6 ... 1e-2, share > 0.9 from 1 on.
    """
    samples, phi, spectra = _spectra(ensemble)
    gaps = {kappa: _gap(of) for kappa, of in spectra.items()}
    parts = {
        "k_T/k_N in 1e-10 ... 1e-8": [
            Part(f"gap at {at(phi, k)}", gaps[k], 0.0) for k in _within(gaps, *SEPARATE)
        ],
        "k_T/k_N in 1e-6 ... 1e-2": [
            Part(f"gap at {at(phi, k)}", gaps[k], high=0.0) for k in _within(gaps, *OVERLAP)
        ],
        "k_T/k_N ≥ 1": [
            Part(f"share at {at(phi, k)}", _share_above(of), PURE)
            for k, of in _within(spectra, *MERGED).items()
        ],
    }
    return Outcome(every(parts), _gap_and_size(samples.n, _within(gaps, *OVERLAP)))


def _gap(of: Modes) -> Estimate:
    gap = per_sample(lambda r, t: np.log10(t[0] / r[-1]), of.rotational, of.translational)
    return mean(gap)


def _share_above(of: Modes) -> Estimate:
    return mean(per_sample(lambda r, t: np.mean(r > t[0]), of.rotational, of.translational))


def _gap_and_size(n: int, gaps: dict[float, Estimate]) -> str:
    """A gap at this N that is one of its box: the N at which the lowest sound wave closes it."""
    open_gaps = {kappa: gap.value for kappa, gap in gaps.items() if gap.value > 0}
    listed = ", ".join(f"{n * 100**gap:.0e} at κ = {k:g}" for k, gap in open_gaps.items())
    sentence = "The lowest translational mode is a sound wave of the box, ω ∝ N^(-1/2); it meets"
    return f"{sentence} the rotational band at N ≈ {listed}." if listed else ""


@claim("A9", unit="1")
def peak_and_collapse(ensemble) -> Outcome:
    """D peaks at ω ≃ ω_R; ω_R D collapses in 0.1 < ω/ω_R < 1 for k_T/k_N ≤ 0.01 (Fig. 10).

    Peak: maximum over 0.1 < ω/ω_R < 2 of D of a sample, smoothed by 0.1. Collapse: area between
    ω_R D and that of the smallest k_T, over the area below the latter, in nine bins.

    Criterion: the peak lies at ω/ω_R = 0.5 ... 2, and the area between two curves is below 0.1.
    """
    _, phi, spectra = _spectra(ensemble)
    scaled = {k: of.frequency / np.sqrt(k) for k, of in _within(spectra, TINY, SCALING).items()}
    peaks = {kappa: mean(_peak(x)) for kappa, x in scaled.items()}
    counts = {kappa: _counts(x) for kappa, x in scaled.items()}
    parts = {
        "k_T/k_N ≤ 0.01": [
            Part(f"peak at {at(phi, k)}", peak, 0.5, 2.0) for k, peak in peaks.items()
        ],
        "two k_T/k_N ≤ 0.01": [
            Part(f"area at {at(phi, k)}", _area_between(counts[k], counts[min(counts)]), high=0.1)
            for k in sorted(counts)[1:]
        ],
    }
    return Outcome(every(parts), _peaks_and_chi_squared(peaks, counts))


def _peak(scaled: np.ndarray) -> np.ndarray:
    """omega / omega_R of the maximum of D of each sample, (S,)."""
    grid = np.linspace(0.1, 2.0, 191)

    def highest(row: np.ndarray) -> float:
        return grid[np.exp(-(((grid[:, None] - row) / SMOOTHING) ** 2) / 2).sum(axis=1).argmax()]

    return per_sample(highest, np.where(scaled < 2 * REGION, scaled, np.nan))


def _counts(scaled: np.ndarray) -> np.ndarray:
    """Modes of each sample in the bins of `WINDOW`, (S, B)."""
    return per_sample(lambda row: np.histogram(row, WINDOW)[0].astype(float), scaled)


def _area_between(counts: np.ndarray, reference: np.ndarray) -> Estimate:
    def area(a: np.ndarray, b: np.ndarray) -> float:
        return np.abs(a.mean(axis=0) - b.mean(axis=0)).sum() / b.mean(axis=0).sum()

    return jackknife(area, counts, reference)


def _peaks_and_chi_squared(peaks: dict[float, Estimate], counts: dict[float, np.ndarray]) -> str:
    first, *others = counts
    chi = (f"{_chi_squared(counts[k], counts[first]):.2g} at κ = {k:g}" for k in others)
    listed = ", ".join(f"{text(peak)} at κ = {kappa:g}" for kappa, peak in peaks.items())
    return (
        f"The peak lies at ω/ω_R = {listed}. χ² per bin of two curves, their errors taken as "
        f"independent: {', '.join(chi)}."
    )


def _chi_squared(counts: np.ndarray, reference: np.ndarray) -> float:
    pair = [statistics.average(rows.T, np.isfinite(rows.T)) for rows in (counts, reference)]
    variance = sum(of.standard_error**2 for of in pair)
    filled = variance > 0
    return np.mean((pair[0].mean - pair[1].mean)[filled] ** 2 / variance[filled])


@claim("A10", unit="1")
def area_of_rotational_band(ensemble) -> Outcome:
    """The integral of D over Region I does not depend on k_T/k_N (footnote 3).

    Number of rotational modes (ψ^R > 1/2) relative to that at the smallest k_T, paired by seed,
    for k_T/k_N ≤ 0.01, where A scales D.

    Criterion: |relative difference| < 5 %.
    """
    samples, phi, spectra = _spectra(ensemble)
    areas = {kappa: _rotational_count(of) for kappa, of in spectra.items()}
    scaled = sorted(_within(areas, TINY, SCALING))
    parts = [
        Part(at(phi, kappa), relative_difference(areas[kappa], areas[scaled[0]]), -0.05, 0.05)
        for kappa in scaled[1:]
    ]
    shares = ", ".join(
        f"{text(mean(area / (3 * samples.n)))} at κ = {k:g}" for k, area in areas.items()
    )
    return Outcome(parts, f"∫ D dω over the rotational modes is {shares}.")


def _rotational_count(of: Modes) -> np.ndarray:
    count = np.isfinite(of.rotational).sum(axis=1)
    return np.where(np.isfinite(of.frequency).any(axis=1), count, np.nan)


@claim("A11", unit="1")
def frictionless_band(ensemble) -> Outcome:
    """At k_T/k_N = 1e-8 the translational band is the spectrum of frictionless grains (Fig. 11).

    Relative shift of the translational ω against those at k_T = 0, rank by rank in each sample
    (at 50 shares of the band, where the numbers of modes differ); its mean size.

    Criterion: the mean shift is below 1 %.
    """
    samples = richest(separable(ensemble), SEPARABLE)
    phis = [p for p in samples.phis(SEPARABLE, 0.0) if samples.kappas(SEPARABLE, p, TINY, LIMIT)]
    if not phis:
        raise NotAsked("spectra at k_T = 0 and at a k_T/k_N ≤ 1e-8")
    phi, kappa = phis[-1], samples.kappas(SEPARABLE, phis[-1], TINY, LIMIT)[-1]
    with_friction, without = modes(samples, phi, kappa).translational, frictionless(samples, phi)
    counts = [np.isfinite(band).sum(axis=1).mean() for band in (with_friction, without)]
    shift = Part(at(phi, kappa), mean(per_sample(_shift, with_friction, without)), high=0.01)
    note = f"{counts[0]:.1f} translational modes against {counts[1]:.1f} without friction."
    return Outcome([shift], note)


def _shift(band: np.ndarray, reference: np.ndarray) -> float:
    if len(band) != len(reference):
        shares = (np.arange(50) + 0.5) / 50
        band, reference = np.quantile(band, shares), np.quantile(reference, shares)
    return np.mean(np.abs(band / reference - 1.0))
