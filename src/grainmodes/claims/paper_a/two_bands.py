"""Claims of paper A on the two bands, their modes and the gap between them: A7, A8, A11 and A20.

    symbol    name                                          paper A
    omega     frequency = eigenvalue^(1/2)                  Sec. III A
    psi^R     psi_rotational; rotational: psi^R > 1/2       Eq. 50
    omega_R   (k_T/k_N)^(1/2) / t_0                         Sec. IV B
    kappa     kt = k_T/k_N
    Region I  rotational band, omega < 2 omega_R (the upper end of A's window of bins)
    Region II translational band, omega > 2 omega_R

Positions are measured in each sample; means and errors are those over the samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.bands import (
    SEPARABLE,
    Modes,
    frictionless,
    log_quantiles,
    mean_in,
    modes,
    per_sample,
    separable,
)
from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.paper_a.ranges import PAPER_GRAINS, WEAK_KAPPA, enough_grains
from grainmodes.claims.paper_a.spectra import REGION_BOUNDARY, friction_spectra, within
from grainmodes.claims.part import Part
from grainmodes.claims.samples import ABOVE_ZERO, best_sampled, label
from grainmodes.statistics.estimates import Estimate, mean

if TYPE_CHECKING:
    import xarray as xr

MIN_PURITY = 0.9
"""Mean psi above which a region counts as purely rotational or translational."""

SEPARATE_RANGE, OVERLAP_RANGE, MERGED_RANGE = (1e-10, 1e-8), (1e-6, 1e-2), (1.0, np.inf)
"""k_T/k_N of A's three kinds of spectrum (Sec. IV B)."""


@claim("A7", unit="1")
def pure_regions(ensemble: xr.Dataset) -> Outcome:
    """Region I is rotational for k_T/k_N ≤ 1e-4, and Region II is translational for k_T/k_N < 1.

    These are the mean of ψ^R over the modes with ω < 2 ω_R, and of ψ^T over those with ω > 2 ω_R.

    Asked of: the largest φ with spectra; a k_T/k_N ≤ 1e-4 in Region I, and < 1 in Region II.

    Criterion: The mean ψ^R of Region I and the mean ψ^T of Region II are above 0.9.
    """
    _, phi, spectra = friction_spectra(ensemble)
    rotational = [
        Part(f"ψ^R in I at {label(phi, kappa)}", _purity(found, kappa, rotational=True), MIN_PURITY)
        for kappa, found in within(spectra, ABOVE_ZERO, 1e-4).items()
    ]
    translational = [
        Part(
            f"ψ^T in II at {label(phi, kappa)}", _purity(found, kappa, rotational=False), MIN_PURITY
        )
        for kappa, found in spectra.items()
        if kappa < MERGED_RANGE[0]
    ]
    return Outcome({"k_T/k_N ≤ 1e-4": rotational, "k_T/k_N < 1": translational})


def _purity(found: Modes, kappa: float, rotational: bool) -> Estimate:
    region = REGION_BOUNDARY * np.sqrt(kappa)
    if rotational:
        return mean_in(found.psi_rotational, found.frequency < region)
    return mean_in(1.0 - found.psi_rotational, found.frequency > region)


@claim("A8", unit="1")
def gap_overlap_merger(ensemble: xr.Dataset) -> Outcome:
    """The bands separate at k_T/k_N = 1e-10 ... 1e-8, overlap at 1e-6 ... 1e-2 and merge from 1 on.

    The gap is log10 of the lowest translational ω over the highest rotational ω of a sample, in
    decades; it is negative where the bands overlap. From k_T/k_N = 1 on the measured number is the
    share of rotational modes above the lowest translational one. The lowest translational mode is a
    sound wave of the box, which moves down as N^(-1/2): in a box smaller than A's a gap says
    nothing about the gap or the overlap that A sees, whichever of the two is found.

    Asked of: the largest φ with spectra; a k_T/k_N of each of the three ranges; gaps at N ≥ 4096.

    Criterion: The gap is above 0 in 1e-10 ... 1e-8 and below 0 in 1e-6 ... 1e-2, and the share is
    above 0.9 from 1 on.
    """
    samples, phi, spectra = friction_spectra(ensemble)
    gaps = {kappa: _gap(found) for kappa, found in spectra.items()}
    needs = enough_grains(samples.n, PAPER_GRAINS)
    parts = {
        "k_T/k_N in 1e-10 ... 1e-8": [
            Part(f"gap at {label(phi, k)}", gaps[k], low=0.0, needs=needs)
            for k in within(gaps, *SEPARATE_RANGE)
        ],
        "k_T/k_N in 1e-6 ... 1e-2": [
            Part(f"gap at {label(phi, k)}", gaps[k], high=0.0, needs=needs)
            for k in within(gaps, *OVERLAP_RANGE)
        ],
        "k_T/k_N ≥ 1": [
            Part(f"share at {label(phi, k)}", _share_above(found), MIN_PURITY)
            for k, found in within(spectra, *MERGED_RANGE).items()
        ],
    }
    return Outcome(parts, _gap_and_size(samples.n, within(gaps, *OVERLAP_RANGE)))


def _gap(found: Modes) -> Estimate:
    gap = per_sample(lambda r, t: np.log10(t[0] / r[-1]), found.rotational, found.translational)
    return mean(gap)


def _share_above(found: Modes) -> Estimate:
    return mean(per_sample(lambda r, t: np.mean(r > t[0]), found.rotational, found.translational))


def _gap_and_size(n: int, gaps: dict[float, Estimate]) -> str:
    """A sentence on gaps that only a finite box has: the N at which a sound wave closes them."""
    open_gaps = {kappa: gap.value for kappa, gap in gaps.items() if gap.value > 0}
    listed = ", ".join(f"{n * 100**gap:.0e} at κ = {k:g}" for k, gap in open_gaps.items())
    sentence = "The lowest translational mode is a sound wave of the box with ω ∝ N^(-1/2); it"
    return f"{sentence} reaches the rotational band at N ≈ {listed}." if listed else ""


@claim("A11", unit="1")
def frictionless_band(ensemble: xr.Dataset) -> Outcome:
    """At k_T/k_N = 1e-8 the translational band is the spectrum of frictionless grains (Fig. 11).

    This is the mean over the modes of |ω/ω' - 1| of the translational ω and the ω' at k_T = 0 with
    the same rank in the sample, or at 50 quantiles of the bands if the numbers of modes differ.

    Asked of: the largest φ with spectra at k_T = 0 and at a k_T/k_N ≤ 1e-8.

    Criterion: The mean relative shift of ω is below 1 %.
    """
    samples = best_sampled(separable(ensemble), SEPARABLE)
    phis = [
        p
        for p in samples.phis(SEPARABLE, 0.0)
        if samples.kappas(SEPARABLE, p, ABOVE_ZERO, WEAK_KAPPA)
    ]
    if not phis:
        raise NotTested("spectra at k_T = 0 and at a k_T/k_N ≤ 1e-8")
    phi, kappa = (
        phis[-1],
        samples.kappas(SEPARABLE, phis[-1], ABOVE_ZERO, WEAK_KAPPA)[-1],
    )
    with_friction, without = modes(samples, phi, kappa).translational, frictionless(samples, phi)
    counts = [np.isfinite(band).sum(axis=1).mean() for band in (with_friction, without)]
    shift = Part(label(phi, kappa), mean(per_sample(_shift, with_friction, without)), high=0.01)
    note = f"There are {counts[0]:.1f} translational modes, and {counts[1]:.1f} without friction."
    return Outcome({"k_T/k_N ≤ 1e-8": [shift]}, note)


def _shift(band: np.ndarray, reference: np.ndarray) -> float:
    if len(band) != len(reference):
        quantiles = (np.arange(50) + 0.5) / 50
        band, reference = np.quantile(band, quantiles), np.quantile(reference, quantiles)
    return np.mean(np.abs(band / reference - 1.0))


@claim("A20", unit="1")
def translational_band_is_fixed(ensemble: xr.Dataset) -> Outcome:
    """D of Region II is almost independent of k_T/k_N for k_T/k_N ≤ 1e-2 (Fig. 9).

    Region II at a k_T are the modes with ω > 2 ω_R. These are the differences of log ω at nine
    quantiles (0.1 ... 0.9) of it to those of the modes above the same ω at the smallest k_T, of
    which the largest is taken, paired by seed.

    Asked of: the largest φ with spectra, every k_T/k_N ≤ 0.01 and at least two of them.

    Criterion: The largest difference of log ω is below 5 %.
    """
    _, phi, spectra = friction_spectra(ensemble)
    weak = within(spectra, ABOVE_ZERO, OVERLAP_RANGE[1])
    shifts = {
        kappa: _region(found, kappa) - _region(weak[min(weak)], kappa)
        for kappa, found in weak.items()
        if kappa > min(weak)
    }
    parts = [
        Part(label(phi, kappa), mean(np.abs(shift).max(axis=1)), high=0.05)
        for kappa, shift in shifts.items()
    ]
    return Outcome({"two k_T/k_N ≤ 0.01": parts})


def _region(found: Modes, kappa: float) -> np.ndarray:
    """log ω at `QUANTILES` of the modes in Region II of this k_T, (S, Q)."""
    inside = found.frequency > REGION_BOUNDARY * np.sqrt(kappa)
    return log_quantiles(np.where(inside, found.frequency, np.nan))
