"""Claims of paper A on rattlers, system size and φ in the density of states: A13 to A15.

symbol    name                                          paper A
omega     frequency = eigenvalue^(1/2)                  Sec. III A
omega_R   (k_T/k_N)^(1/2) / t_0                         Sec. IV B
p         participation_ratio                           Eq. E1
N, phi    n, phi                                        App. I, App. J
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.bands import (
    QUANTILES,
    SEPARABLE,
    Modes,
    log_quantiles,
    median_log,
    modes,
    separable,
)
from grainmodes.claims.claim import NotTested, Outcome, claim
from grainmodes.claims.paper_a.ranges import PAPER_GRAINS, WEAK_KAPPA, enough_grains
from grainmodes.claims.part import Part
from grainmodes.claims.samples import (
    ABOVE_ZERO,
    Samples,
    best_sampled,
    label,
    samples_by_size,
)
from grainmodes.statistics import averages
from grainmodes.statistics.estimates import Estimate, difference_of_means, mean
from grainmodes.statistics.shares import share

if TYPE_CHECKING:
    import xarray as xr

MAX_LOCALISED_GRAINS = 2.0
"""N p below which a mode counts as localised on one grain."""

MAX_RATTLER_CONTACTS = 2
"""Z_Th of A: a grain with so few contacts is a rattler."""

HALF = 0.5

RATTLER_NAMES = ("eigenvalue_rattlers", "participation_ratio_rattlers", "peak_contacts_rattlers")

ABOVE_SOUND = 2.0
"""Lowest ω, in units of the lowest sound wave of the smaller box, at which two N are compared."""


@claim("A13", unit="1")
def localised_rattlers(ensemble: xr.Dataset) -> Outcome:
    """Modes with p ≈ 1/N lie at ωt_0 ≈ 1e-5 for k_T/k_N = 1e-8, 1e-3 for 1e-4; rattlers (Fig. 14).

    Both frequencies are ω_R / 10. Such modes have N p < 2 and ω within half a decade of ω_R / 10,
    in spectra with the rattlers kept, at all φ. Seeds are independent; the modes of a packing and
    the φ of a seed are not. The first number is therefore the share of the seeds that have such a
    mode at half of the φ or more; a small system may have none by chance. The second is the share
    of the seeds in which most of these modes belong to a rattler in A's sense: the grain that moves
    most has at most two contacts.

    Asked of: k_T/k_N in 1e-8 ... 1e-4, spectra with rattlers kept, at N ≥ 4096, as A's Fig. 14.

    Criterion: More than one half of the seeds have such modes, and in more than one half of the
    seeds most of them sit on grains with at most two contacts.
    """
    samples = best_sampled(ensemble, *RATTLER_NAMES)
    needs = enough_grains(samples.n, PAPER_GRAINS)
    existing, shares, zero = [], [], 0
    for kappa in samples.kappas(RATTLER_NAMES[0], low=WEAK_KAPPA, high=1e-4):
        phis = samples.phis(RATTLER_NAMES[0], kappa)
        found = np.array([_localised(samples, phi, kappa) for phi in phis])
        number, on_rattlers, free = found.transpose(1, 0, 2)
        with np.errstate(invalid="ignore"):
            at_phis = np.nansum(number > 0, axis=0) / np.isfinite(number).sum(axis=0)
            weak = np.nansum(on_rattlers, axis=0) / np.nansum(number, axis=0)
        having = share(np.where(np.isfinite(at_phis), at_phis >= HALF, np.nan))
        where = label(kappa=kappa)
        existing.append(Part(f"seeds with one at {where}", having, low=HALF, needs=needs))
        most = share(np.where(np.isfinite(weak), weak > HALF, np.nan))
        shares.append(Part(f"seeds with most on rattlers at {where}", most, low=HALF, needs=needs))
        zero += int(np.nansum(free))
    note = f"Rattlers without a contact have {zero} zero modes, whose p is not defined."
    return Outcome({"spectra with rattlers kept": [*existing, *shares]}, note)


def _localised(samples: Samples, phi: float, kappa: float) -> np.ndarray:
    """Numbers (3, S), NaN without a spectrum: of localised modes near ω_R / 10, of those among them
    that sit on a rattler, and of zero modes beyond the translations."""
    eigenvalue, ratio, contacts = (samples.values(name, phi, kappa) for name in RATTLER_NAMES)
    found = averages.frequencies(eigenvalue)
    with np.errstate(invalid="ignore"):
        decades = np.abs(np.log10(found.frequency / np.sqrt(kappa)) + 1.0)
        near = (decades < 0.5) & (samples.n * ratio < MAX_LOCALISED_GRAINS)
        weak = near & (contacts <= MAX_RATTLER_CONTACTS)
    free = np.maximum(found.zero - averages.TRANSLATIONS, 0)
    numbers = np.array([near.sum(axis=1), weak.sum(axis=1), free], float)
    return np.where(np.isfinite(eigenvalue).any(axis=1), numbers, np.nan)


@claim("A14", unit="1")
def independent_of_size(ensemble: xr.Dataset) -> Outcome:
    """D does not depend on N (Fig. 15).

    These are the differences of log ω between the two largest N at nine quantiles (0.1 ... 0.9) of
    each band, at the k_T/k_N closest to 1e-8. The lowest translational modes are sound waves of the
    box, at frequencies that its size sets: modes below twice the lowest of the smaller box are left
    out at both N.

    Asked of: the two largest N with spectra at one point; both N ≥ 256.

    Criterion: The differences of log ω at nine quantiles of each band are within ±5 %.
    """
    by_size = samples_by_size(separable(ensemble), SEPARABLE)[-2:]
    common = set.intersection(*(set(s.points(SEPARABLE, ABOVE_ZERO)) for s in by_size))
    if len(by_size) < 2 or not common:
        raise NotTested("spectra of two N at one φ and k_T")
    point = max(common, key=lambda point: (point[0], -abs(np.log(point[1] / WEAK_KAPPA))))
    small, large = (modes(samples, *point) for samples in by_size)
    lowest = ABOVE_SOUND * np.nanmean(np.nanmin(small.translational[_known(small)], axis=1))
    bands = {
        "rotational": (small.rotational, large.rotational),
        "translational": [
            np.where(size.translational > lowest, size.translational, np.nan)
            for size in (small, large)
        ],
    }
    needs = enough_grains(by_size[0].n)
    parts = [
        Part(f"{name} ω at quantile {q:.1f}, {label(*point)}", apart, -0.05, 0.05, needs=needs)
        for name, pair in bands.items()
        for q, apart in zip(QUANTILES, _differences(*pair), strict=True)
    ]
    note = f"The systems have N = {by_size[0].n} and N = {by_size[1].n}."
    return Outcome({"spectra of two N": parts}, note)


def _known(found: Modes) -> np.ndarray:
    return np.isfinite(found.translational).any(axis=1)


def _differences(small: np.ndarray, large: np.ndarray) -> list[Estimate]:
    """log omega of the large minus that of the small system at `QUANTILES`; they share no seed."""
    pairs = zip(log_quantiles(small).T, log_quantiles(large).T, strict=True)
    return [difference_of_means(*pair) for pair in pairs]


@claim("A15", unit="decades")
def towards_jamming(ensemble: xr.Dataset) -> Outcome:
    """Towards jamming the rotational band moves down and the translational band widens (Fig. 16).

    The shift of the rotational band is log10 of its median ω at the highest φ over that at the
    lowest φ. The width of the translational band is log10 of ω at its quantile 0.9 over ω at 0.1;
    the measured number is the width at the lowest φ minus that at the highest. Both are paired by
    seed, at the smallest k_T.

    Asked of: the lowest and the highest φ with spectra, at one k_T > 0.

    Criterion: The median rotational ω falls, and the width of the translational band grows.
    """
    samples = best_sampled(separable(ensemble), SEPARABLE)
    kappa = min(_at_most_phis(samples), default=0.0)
    phis = samples.phis(SEPARABLE, kappa)
    if len(phis) < 2 or kappa == 0.0:
        raise NotTested("spectra at two area fractions and one k_T > 0, with jammed samples")
    low, high = (modes(samples, phi, kappa) for phi in (phis[0], phis[-1]))
    down = mean(median_log(high.rotational) - median_log(low.rotational))
    wider = mean(_width(low.translational) - _width(high.translational))
    where = f"φ = {phis[0]:g} and {phis[-1]:g}, {label(kappa=kappa)}"
    return Outcome(
        {"two φ": [Part(f"band, {where}", down, 0.0), Part(f"plateau, {where}", wider, 0.0)]},
        f"The rotational band moves by {down} and the plateau widens by {wider} decades.",
    )


def _at_most_phis(samples: Samples) -> list[float]:
    """The values of k_T > 0 with spectra at most area fractions."""
    kappas = samples.kappas(SEPARABLE, low=ABOVE_ZERO)
    numbers = [len(samples.phis(SEPARABLE, kappa)) for kappa in kappas]
    return [kappa for kappa, n in zip(kappas, numbers, strict=True) if n == max(numbers)]


def _width(band: np.ndarray) -> np.ndarray:
    """log10 of omega at quantile 0.9 over omega at quantile 0.1 of each sample, (S,)."""
    ends = log_quantiles(band, np.array([0.1, 0.9]))
    return (ends[:, 1] - ends[:, 0]) / np.log(10.0)
