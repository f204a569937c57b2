"""The claim of paper A on the non-affine rigidity and its sign: A6.

    symbol        name                   paper A
    G_NA          g_nonaffine            Eq. 41, unloaded step
    g_NA          g_nonaffine_loaded     the same with the tangential springs loaded
    kappa         kt = k_T/k_N

Every comparison is paired, because the packings of one seed are the same at all k_T.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.part import MIN_SAMPLES, Part
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled, label
from grainmodes.ensemble.trends import sign_changes
from grainmodes.statistics.estimates import Estimate, mean, relative_difference

if TYPE_CHECKING:
    import xarray as xr

BELOW, ABOVE = 1.0, 5.0
"""The neighbours of k_T/k_N = 2 on A's grid, between which G_NA changes its sign."""


@claim("A6", unit="1")
def nonaffine_sign_change(ensemble: xr.Dataset) -> Outcome:
    """G_NA is negative for k_T/k_N < 2 and positive above, and |G_NA| grows with φ (Fig. 6).

    These are the means of g_nonaffine (unloaded step) at the largest k_T/k_N ≤ 1 and at the
    smallest ≥ 5: A's grid has 1, 2 and 5, so that its figure tells nothing closer about where the
    sign changes. The k_T/k_N of the change, κ*, is reported and is claim G1. The growth is the
    relative difference of |G_NA| at the lowest φ to that at the highest, at the smallest and at the
    largest k_T, paired by seed.

    Asked of: every φ with a k_T/k_N ≤ 1 and one ≥ 5; two φ.

    Criterion: G_NA is below 0 at k_T/k_N ≤ 1 and above 0 at k_T/k_N ≥ 5, at every φ, and |G_NA| is
    larger at the highest φ than at the lowest.
    """
    samples = best_sampled(ensemble, "g_nonaffine", "g_nonaffine_loaded")
    phis = samples.phis("g_nonaffine")
    weak = {phi: samples.kappas("g_nonaffine", phi, ABOVE_ZERO, BELOW) for phi in phis}
    strong = {phi: samples.kappas("g_nonaffine", phi, ABOVE) for phi in phis}
    below = [(phi, kappas[-1]) for phi, kappas in weak.items() if kappas]
    above = [(phi, kappas[0]) for phi, kappas in strong.items() if kappas]
    parts = {
        "k_T/k_N ≤ 1": [Part(label(*p), _mean(samples, *p), high=0.0) for p in below],
        "k_T/k_N ≥ 5": [Part(label(*p), _mean(samples, *p), low=0.0) for p in above],
        "two area fractions": [
            _growth(samples, kappa, phis) for kappa in _ends(samples, phis) if len(phis) > 1
        ],
    }
    return Outcome(parts, " ".join(filter(None, (_crossings(samples), _loading(samples)))))


def _ends(samples: Samples, phis: list[float]) -> list[float]:
    """The smallest and the largest k_T with samples at the lowest and at the highest φ."""
    kappas = samples.common_kappas("g_nonaffine", (phis[0], phis[-1]))
    return list(dict.fromkeys((*kappas[:1], *kappas[-1:])))


def _mean(samples: Samples, phi: float, kappa: float) -> Estimate:
    return mean(samples.values("g_nonaffine", phi, kappa))


def _growth(samples: Samples, kappa: float, phis: list[float]) -> Part:
    low, high = (np.abs(samples.values("g_nonaffine", phi, kappa)) for phi in (phis[0], phis[-1]))
    return Part(f"growth at {label(kappa=kappa)}", relative_difference(low, high), high=0.0)


def _crossings(samples: Samples) -> str:
    found = sign_changes(samples.ensemble, samples.n, MIN_SAMPLES)
    listed = ", ".join(f"{zero} at {label(phi)}" for phi, zero in found.items())
    return f"The unloaded G_NA crosses 0 at κ* = {listed}." if found else ""


def _loading(samples: Samples) -> str:
    """A sentence on the sign of G_NA if the step loads the tangential springs."""
    points = samples.points("g_nonaffine_loaded", ABOVE_ZERO)
    if not points:
        return ""
    loaded = np.array([samples.values("g_nonaffine_loaded", *point) for point in points])
    (phi, kappa), last = points[-1], samples.values("g_nonaffine", *points[-1])
    return (
        "The sign is that of a step that does not load the tangential springs. If they are loaded, "
        "g_NA = -aᵀJ⁺a/L² ≤ 0; it is positive in "
        f"{int((loaded > 0).sum())} of {int(np.isfinite(loaded).sum())} samples. At "
        f"{label(phi, kappa)} G_NA is {mean(loaded[-1])} loaded and {mean(last)} unloaded."
    )
