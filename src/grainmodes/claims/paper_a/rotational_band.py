"""Claims of paper A on the shape of the rotational band: A9, A10 and A22.

    symbol    name                                          paper A
    omega     frequency = eigenvalue^(1/2)                  Sec. III A
    psi^R     psi_rotational; rotational: psi^R > 1/2       Eq. 50
    omega_R   (k_T/k_N)^(1/2) / t_0                         Sec. IV B
    kappa     kt = k_T/k_N

Positions are measured in each sample; means and errors are those over the samples.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.bands import SEPARABLE, Modes, frictionless, per_sample
from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.paper_a.spectra import REGION_BOUNDARY, friction_spectra, within
from grainmodes.claims.part import Part
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled, label
from grainmodes.statistics import averages
from grainmodes.statistics.binning import occupation
from grainmodes.statistics.estimates import Estimate, jackknife, mean, relative_difference

if TYPE_CHECKING:
    import xarray as xr

MAX_SCALING_KAPPA = 0.01
"""Largest k_T/k_N for which A finds omega_R D to collapse."""

WINDOW_EDGES = np.linspace(0.1, 1.0, 10)
"""Edges in omega / omega_R of the bins in which curves are compared (A, Fig. 10)."""

SMOOTHING_WIDTH = 0.1
"""Width in omega / omega_R of the Gaussian that smooths D before its peak is sought."""


@claim("A9", unit="1")
def peak_and_collapse(ensemble: xr.Dataset) -> Outcome:
    """D peaks at ω ≃ ω_R, and ω_R D collapses in 0.1 < ω/ω_R < 1 for k_T/k_N ≤ 0.01 (Fig. 10).

    The peak is the maximum over 0.1 < ω/ω_R < 2 of D of a sample, smoothed by 0.1. On A's axis of
    five decades "≃" is a factor of 2; the note says where the peak lies. The collapse is
    measured by the area between ω_R D and that of the smallest k_T, over the area below the latter,
    in nine bins.

    Asked of: the largest φ with spectra, every k_T/k_N ≤ 0.01 and at least two of them.

    Criterion: The peak lies at ω/ω_R = 0.5 ... 2, and the area between two curves is below 0.1.
    """
    _, phi, spectra = friction_spectra(ensemble)
    scaled = {
        k: found.frequency / np.sqrt(k)
        for k, found in within(spectra, ABOVE_ZERO, MAX_SCALING_KAPPA).items()
    }
    peaks = {kappa: mean(_peak(x)) for kappa, x in scaled.items()}
    counts = {kappa: _counts(x) for kappa, x in scaled.items()}
    parts = {
        "k_T/k_N ≤ 0.01": [
            Part(f"peak at {label(phi, k)}", peak, 0.5, 2.0) for k, peak in peaks.items()
        ],
        "two k_T/k_N ≤ 0.01": [
            Part(
                f"area at {label(phi, k)}", _area_between(counts[k], counts[min(counts)]), high=0.1
            )
            for k in sorted(counts)[1:]
        ],
    }
    return Outcome(parts, _peaks_and_chi_squared(peaks, counts))


def _peak(scaled: np.ndarray) -> np.ndarray:
    """omega / omega_R of the maximum of D of each sample, (S,)."""
    grid = np.linspace(0.1, 2.0, 191)

    def highest(row: np.ndarray) -> float:
        return grid[
            np.exp(-(((grid[:, None] - row) / SMOOTHING_WIDTH) ** 2) / 2).sum(axis=1).argmax()
        ]

    return per_sample(highest, np.where(scaled < 2 * REGION_BOUNDARY, scaled, np.nan))


def _counts(scaled: np.ndarray) -> np.ndarray:
    """Modes of each sample in the bins of `WINDOW_EDGES`, (S, B)."""
    return per_sample(lambda row: np.histogram(row, WINDOW_EDGES)[0].astype(float), scaled)


def _area_between(counts: np.ndarray, reference: np.ndarray) -> Estimate:
    def area(a: np.ndarray, b: np.ndarray) -> float:
        return np.abs(a.mean(axis=0) - b.mean(axis=0)).sum() / b.mean(axis=0).sum()

    return jackknife(area, counts, reference)


def _peaks_and_chi_squared(peaks: dict[float, Estimate], counts: dict[float, np.ndarray]) -> str:
    if not counts:
        return ""
    first, *others = counts
    listed = ", ".join(f"{peak} at κ = {kappa:g}" for kappa, peak in peaks.items())
    beside = max((abs(peak.value - 1.0) for peak in peaks.values()), default=0.0)
    note = f"The peak lies at ω/ω_R = {listed}, up to {100 * beside:.0f} % beside ω_R."
    if not others:
        return note
    chi = ", ".join(f"{_chi_squared(counts[k], counts[first]):.2g} at κ = {k:g}" for k in others)
    return f"{note} With independent errors, χ² per bin of two curves is {chi}."


def _chi_squared(counts: np.ndarray, reference: np.ndarray) -> float:
    pair = [averages.average(rows.T, np.isfinite(rows.T)) for rows in (counts, reference)]
    variance = sum(average.standard_error**2 for average in pair)
    filled = variance > 0
    return np.mean((pair[0].mean - pair[1].mean)[filled] ** 2 / variance[filled])


@claim("A10", unit="1")
def area_of_rotational_band(ensemble: xr.Dataset) -> Outcome:
    """The integral of D over Region I does not depend on k_T/k_N (footnote 3).

    This is the relative difference of the number of rotational modes (ψ^R > 1/2) to that at the
    smallest k_T, paired by seed, for k_T/k_N ≤ 0.01, where A scales D. A calls it "almost"
    independent. The note has the same difference for all modes with ω < 2 ω_R minus those that
    frictionless grains have there.

    Asked of: the largest φ with spectra, every k_T/k_N ≤ 0.01 and at least two of them.

    Criterion: The relative difference of the number of rotational modes is within ±10 %.
    """
    samples, phi, spectra = friction_spectra(ensemble)
    areas = {kappa: _rotational_count(found) for kappa, found in spectra.items()}
    scaled = sorted(within(areas, ABOVE_ZERO, MAX_SCALING_KAPPA))
    parts = [
        Part(label(phi, kappa), relative_difference(areas[kappa], areas[scaled[0]]), -0.1, 0.1)
        for kappa in scaled[1:]
    ]
    shares = ", ".join(f"{mean(area / (3 * samples.n))} at κ = {k:g}" for k, area in areas.items())
    note = f"The integral ∫ D dω over the rotational modes is {shares}."
    if samples.kappas(SEPARABLE, phi, 0.0, 0.0):
        note += f" {_above_frictionless(samples, phi, spectra, scaled)}"
    return Outcome({"two k_T/k_N ≤ 0.01": parts}, note)


def _above_frictionless(
    samples: Samples, phi: float, spectra: dict[float, Modes], kappas: list[float]
) -> str:
    """A sentence on the modes below 2 ω_R beyond those of frictionless grains."""
    bare = frictionless(samples, phi)

    def surplus(kappa: float) -> np.ndarray:
        end = REGION_BOUNDARY * np.sqrt(kappa)
        with np.errstate(invalid="ignore"):
            here, there = ((band < end).sum(axis=1) for band in (spectra[kappa].frequency, bare))
        return np.where(np.isfinite(spectra[kappa].frequency).any(axis=1), here - there, np.nan)

    listed = ", ".join(
        f"{relative_difference(surplus(k), surplus(kappas[0]))} at κ = {k:g}" for k in kappas[1:]
    )
    return f"Minus the frictionless modes below 2 ω_R the difference is {listed}." if listed else ""


def _rotational_count(found: Modes) -> np.ndarray:
    count = np.isfinite(found.rotational).sum(axis=1)
    return np.where(np.isfinite(found.frequency).any(axis=1), count, np.nan)


@claim("A22", unit="1")
def shape_of_participation(ensemble: xr.Dataset) -> Outcome:
    """The band of p(ω) moves up with k_T/k_N and keeps its shape (App. E, Fig. 14).

    This is the mean of |p(ω/ω_R) - p'(ω/ω_R)| over nine bins of 0.1 < ω/ω_R < 1, over the mean of
    p', the participation ratio of the rotational modes at the smallest k_T.

    Asked of: the largest φ with modes, every k_T/k_N ≤ 0.01 and at least two of them.

    Criterion: The relative difference of the two curves is below 10 %.
    """
    samples = best_sampled(ensemble, "participation_ratio", "eigenvalue")
    phi = samples.phis("participation_ratio")[-1]
    kappas = samples.kappas("participation_ratio", phi, ABOVE_ZERO, MAX_SCALING_KAPPA)
    curves = {kappa: _participation(samples, phi, kappa) for kappa in kappas}
    parts = [
        Part(
            label(phi, kappa),
            jackknife(_curves_apart, *curves[kappa], *curves[kappas[0]]),
            high=0.1,
        )
        for kappa in kappas[1:]
    ]
    return Outcome({"two k_T/k_N ≤ 0.01": parts})


def _participation(samples: Samples, phi: float, kappa: float) -> tuple[np.ndarray, np.ndarray]:
    """Sums of p and numbers of modes of each sample in the bins of `WINDOW_EDGES`, (S, B) each."""
    eigenvalue, ratio = (
        samples.values(name, phi, kappa) for name in ("eigenvalue", "participation_ratio")
    )
    scaled = averages.frequencies(eigenvalue).frequency / np.sqrt(kappa)
    known = np.isfinite(eigenvalue).any(axis=1)[:, None]
    total, count = occupation(scaled, WINDOW_EDGES, ratio), occupation(scaled, WINDOW_EDGES)
    return np.where(known, total, np.nan), np.where(known, count, np.nan)


def _curves_apart(
    total: np.ndarray, count: np.ndarray, other_total: np.ndarray, other_count: np.ndarray
) -> float:
    with np.errstate(invalid="ignore", divide="ignore"):
        curve, other = (
            total.sum(axis=0) / count.sum(axis=0),
            other_total.sum(axis=0) / other_count.sum(axis=0),
        )
    common = np.isfinite(curve) & np.isfinite(other)
    if not common.any():
        return np.nan
    return float(np.mean(np.abs(curve - other)[common]) / np.nanmean(other))
