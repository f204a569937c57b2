"""Claims of paper A on its methods: A12, A18 and A19.

symbol  name                                                     paper A
D, D_H  bin_count, bin_count_hessian over the same bins          Eq. 23, App. H
J, H    hessian_difference = max|H - J| / max|J|                 Eq. 18, App. H
q, q̇    verlet_order_position, verlet_order_velocity             App. B
M⁻¹J    complex_pairs_at_rest of grains compressed with friction   footnote 1
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.bands import spectrum_at
from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.part import Part
from grainmodes.claims.samples import Samples, best_sampled, label
from grainmodes.statistics import averages
from grainmodes.statistics.binning import occupation
from grainmodes.statistics.estimates import Estimate, jackknife, mean
from grainmodes.statistics.shares import share

if TYPE_CHECKING:
    import xarray as xr

DENSITY_TOLERANCE = 0.05
"""Area between two densities of states, over the area below one, that no figure shows."""

MIN_FRICTIONAL_KAPPA = 0.1
"""Smallest k_T/k_N of the states compressed with friction that the claim is tested on."""

ORDERS = {"position": 2.0, "velocity": 1.0}
"""Orders of velocity Verlet that A finds (App. B)."""


@claim("A12", unit="1")
def hessian_density(ensemble: xr.Dataset) -> Outcome:
    """The density of states D of the Jacobian equals that of the effective Hessian, D_H (Fig. 12).

    In A's states, s = 0, H equals J entry by entry, so that the densities are the same by
    construction: the sum over bins of |counts of D - counts of D_H| over the sum of the counts of D
    checks this. A test is the state after a shear of 0.01, where s is not 0: the mean over the
    modes of |ω/ω_H - 1|.

    Asked of: every point with counts of D_H at s = 0, and with spectra of sheared states.

    Criterion: The area between D and D_H, and the mean shift under shear, are below 5 %.
    """
    identity, note = _densities(ensemble) if "bin_count_hessian" in ensemble else ([], "")
    groups = {
        "bin_count_hessian (observables.hessian)": identity,
        "hessian_shift_sheared (claim_diagnostics)": _under_shear(ensemble),
    }
    return Outcome(groups, f"At s = 0 H equals J entry by entry. {note}".strip())


def _under_shear(ensemble: xr.Dataset) -> list[Part]:
    if "hessian_shift_sheared" not in ensemble:
        return []
    samples = best_sampled(ensemble, "hessian_shift_sheared")
    points = samples.points("hessian_shift_sheared")
    shifts = {p: samples.values("hessian_shift_sheared", *p) for p in points}
    return [
        Part(f"sheared, N = {samples.n}, {label(*p)}", mean(shift), high=DENSITY_TOLERANCE)
        for p, shift in shifts.items()
    ]


def _densities(ensemble: xr.Dataset) -> tuple[list[Part], str]:
    samples = best_sampled(ensemble, "bin_count_hessian", "bin_edge")
    points = samples.points("bin_count_hessian")
    parts = [
        Part(label(*p), _area(samples, "bin_count_hessian", p), high=DENSITY_TOLERANCE)
        for p in points
    ]
    if "bin_count_hessian_printed" not in ensemble:
        return parts, ""
    printed = {p: _area(samples, "bin_count_hessian_printed", p) for p in points}
    listed = ", ".join(f"{area} at {label(*point)}" for point, area in printed.items())
    return parts, f"With k_N and k_T as printed in (H2) the area is {listed}."


def _area(samples: Samples, name: str, point: tuple) -> Estimate:
    edges = samples.values("bin_edge", *point)
    bins = int(np.isfinite(edges).any(axis=0).sum()) - 1

    def area(counts: np.ndarray, hessian: np.ndarray) -> float:
        return np.abs(counts.mean(axis=0) - hessian.mean(axis=0)).sum() / counts.mean(axis=0).sum()

    counts = _counts(samples, point, edges[:, : bins + 1])
    return jackknife(area, counts[:, :bins], samples.values(name, *point)[:, :bins])


def _counts(samples: Samples, point: tuple, edges: np.ndarray) -> np.ndarray:
    """Modes of the Jacobian in the bins of the Hessian, (S, B)."""
    eigenvalue = spectrum_at(samples, "eigenvalue", *point)
    if eigenvalue is None:
        counted = spectrum_at(samples, "bin_count", *point)
        if counted is None:
            raise NotTested("bin_count or eigenvalue")
        return counted
    frequency = averages.frequencies(eigenvalue).frequency
    rows = [occupation(row[None], bins)[0] for row, bins in zip(frequency, edges, strict=True)]
    return np.where(np.isfinite(edges[:, 1:]), rows, np.nan)


@claim("A18", unit="1")
def verlet_orders(ensemble: xr.Dataset) -> Outcome:
    """Velocity Verlet with forces that depend on velocity is of order 2 in q and 1 in q̇ (App. B).

    These are the measured orders at every point, averaged over samples.

    Asked of: every point with measured orders.

    Criterion: The order lies within 1.8 ... 2.2 in q and within 0.8 ... 1.2 in q̇.
    """
    names = {kind: f"verlet_order_{kind}" for kind in ORDERS}
    samples = best_sampled(ensemble, *names.values())
    parts = [
        Part(
            f"{kind} at {label(*p)}",
            mean(samples.values(name, *p)),
            ORDERS[kind] - 0.2,
            ORDERS[kind] + 0.2,
        )
        for kind, name in names.items()
        for p in samples.points(name)
    ]
    return Outcome({"orders": parts})


@claim("A19", unit="1")
def complex_pairs_with_friction(ensemble: xr.Dataset) -> Outcome:
    """States compressed with friction have complex pairs of eigenvalues of M⁻¹J (footnote 1).

    This is the share of the seeds of which at least half the jammed states compressed with friction
    have a pair, for k_T/k_N ≥ 0.1. A does not say at which k_T pairs exist, and there are none at
    weak friction. Seeds are independent, states of one seed at several k_T are not.

    Asked of: states compressed with k_T/k_N ≥ 0.1.

    Criterion: More than one half of the seeds have pairs.
    """
    samples = best_sampled(ensemble, "complex_pairs_at_rest", with_friction=True)
    points = samples.points("complex_pairs_at_rest", MIN_FRICTIONAL_KAPPA)
    if not points:
        raise NotTested("complex_pairs_at_rest at k_T/k_N ≥ 0.1, compressed with friction")
    pairs = np.array([samples.values("complex_pairs_at_rest", *point) for point in points])
    having = np.where(np.isfinite(pairs), pairs > 0, np.nan)
    known = np.isfinite(having)
    with np.errstate(invalid="ignore"):
        of_seed = np.nansum(having, axis=0) / known.sum(axis=0)
    seeds = share(np.where(np.isfinite(of_seed), of_seed >= 0.5, np.nan))
    most = np.nanmax(np.where(known, pairs, 0))
    note = f"{np.nansum(having):.0f} of {known.sum()} states have pairs, at most {most:.0f} each."
    return Outcome({"states compressed with friction": [Part("seeds", seeds, 0.5)]}, note)
