"""Claims of paper A on rattlers, system size and φ in the density of states: A13 to A15.

symbol    name                                          paper A
omega     frequency = eigenvalue^(1/2)                  Sec. III A
omega_R   (k_T/k_N)^(1/2) / t_0                         Sec. IV B
p         participation_ratio                           Eq. E1
N, phi    n, phi                                        App. I, App. J
"""

from __future__ import annotations

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
from grainmodes.claims.paper_a.ranges import WEAK_KAPPA
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

MAX_LOCALISED_GRAINS = 2.0
"""N p below which a mode counts as localised on one grain."""


@claim("A13", unit="1")
def localised_rattlers(ensemble) -> Outcome:
    """Modes of rattlers have p ≈ 1/N; ωt_0 ≈ 1e-5 at k_T/k_N = 1e-8 and 1e-3 at 1e-4 (Fig. 14).

    Both frequencies are ω_R / 10. The modes of rattlers are those that a spectrum has only if its
    rattlers are kept. The measured number is the share of them with N p < 2 and ω within half a
    decade of ω_R / 10, for all φ of a seed together.

    Asked of: every point of the ensemble.

    Criterion: More than one half of the modes of rattlers have N p < 2 and ω near ω_R / 10.
    """
    names = ("eigenvalue_rattlers", "participation_ratio_rattlers", "mode_count_rattlers")
    samples = best_sampled(ensemble, *names, "mode_count")
    parts, zero, added = [], 0.0, 0.0
    for kappa in samples.kappas(names[0], low=WEAK_KAPPA, high=1e-4):
        near, vanishing, of_rattlers = np.nansum(
            [_rattler_modes(samples, phi, kappa) for phi in samples.phis(names[0], kappa)], axis=0
        )
        share = np.divide(near, of_rattlers, np.full_like(near, np.nan), where=of_rattlers > 0)
        parts.append(Part(f"share at {label(kappa=kappa)}", mean(share), 0.5))
        zero, added = zero + vanishing.sum(), added + of_rattlers.sum()
    note = f"Of {added:.0f} modes of rattlers, {zero:.0f} are zero modes, whose p is not defined."
    return Outcome({"rattlers": parts}, note)


def _rattler_modes(samples: Samples, phi: float, kappa: float) -> np.ndarray:
    """Numbers (3, S) of localised modes near ω_R / 10, of zero modes, and of modes of rattlers."""
    eigenvalue, participation, count = (
        samples.values(f"{name}_rattlers", phi, kappa)
        for name in ("eigenvalue", "participation_ratio", "mode_count")
    )
    found = averages.frequencies(eigenvalue)
    decades = np.abs(np.log10(found.frequency / np.sqrt(kappa)) + 1.0)
    near = ((decades < 0.5) & (samples.n * participation < MAX_LOCALISED_GRAINS)).sum(axis=1)
    zero = np.maximum(found.zero - averages.TRANSLATIONS, 0)
    return np.array([near, zero, count - samples.values("mode_count", phi, kappa)])


@claim("A14", unit="1")
def independent_of_size(ensemble) -> Outcome:
    """D does not depend on N (Fig. 15).

    These are the differences of log ω between the smallest and the largest N at nine quantiles
    (0.1 ... 0.9) of each band, at the k_T/k_N closest to 1e-8.

    Asked of: every point of the ensemble.

    Criterion: The differences of log ω at nine quantiles of each band are within ±5 %.
    """
    by_size = samples_by_size(separable(ensemble), SEPARABLE)
    common = set.intersection(
        *(set(s.points(SEPARABLE, ABOVE_ZERO)) for s in (by_size[0], by_size[-1]))
    )
    if len(by_size) < 2 or not common:
        raise NotTested("spectra of two N at one φ and k_T")
    point = max(common, key=lambda point: (point[0], -abs(np.log(point[1] / WEAK_KAPPA))))
    small, large = (modes(samples, *point) for samples in (by_size[0], by_size[-1]))
    parts = [
        Part(f"{band} ω at quantile {quantile:.1f}, {label(*point)}", difference, -0.05, 0.05)
        for band in ("rotational", "translational")
        for quantile, difference in zip(QUANTILES, _differences(small, large, band), strict=True)
    ]
    return Outcome(
        {"two N": parts}, f"The systems have N = {by_size[0].n} and N = {by_size[-1].n}."
    )


def _differences(small: Modes, large: Modes, band: str) -> list[Estimate]:
    """log omega of the large minus that of the small system at `QUANTILES`; they share no seed."""
    pairs = zip(*(log_quantiles(getattr(size, band)).T for size in (small, large)), strict=True)
    return [difference_of_means(*pair) for pair in pairs]


@claim("A15", unit="decades")
def towards_jamming(ensemble) -> Outcome:
    """Towards jamming the rotational band moves down and the translational band widens (Fig. 16).

    The shift of the rotational band is log10 of its median ω at the highest φ over that at the
    lowest φ. The width of the translational band is log10 of ω at its quantile 0.9 over ω at 0.1;
    the measured number is the width at the lowest φ minus that at the highest. Both are paired by
    seed, at the smallest k_T.

    Asked of: every point of the ensemble.

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
