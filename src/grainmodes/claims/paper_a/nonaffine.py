"""The claim of paper A on the non-affine rigidity and its sign: A6.

    symbol        name                   paper A
    G_NA          g_nonaffine            Eq. 41, unloaded step
    g_NA          g_nonaffine_loaded     the same with the tangential springs loaded
    kappa         kt = k_T/k_N

Every comparison is paired, because the packings of one seed are the same at all k_T.
"""

from __future__ import annotations

import numpy as np

from grainmodes.claims.claim import Outcome, claim
from grainmodes.claims.part import Part
from grainmodes.claims.samples import ABOVE_ZERO, Samples, best_sampled, label
from grainmodes.statistics.estimates import Estimate, crossing, mean, relative_difference

CROSSING_RANGE = (1.6, 2.5)
"""Range of k_T/k_N that is equal to 2 on A's grid, on which the neighbours of 2 are 1 and 5."""


@claim("A6", unit="1")
def nonaffine_sign_change(ensemble) -> Outcome:
    """G_NA is negative for k_T/k_N < 2 and positive above, and |G_NA| grows with φ (Fig. 6).

    The crossing is the k_T/k_N at which the mean of g_nonaffine (unloaded step) rises through 0, at
    every φ, interpolated linearly in log k_T, with its error from the jackknife over seeds. The
    growth is the relative difference of |G_NA| at the highest and the lowest φ, at the smallest and
    at the largest k_T, paired by seed.

    Asked of: every point of the ensemble.

    Criterion: The crossing lies within 1.6 ... 2.5 at every φ, and |G_NA| is larger at the highest
    φ than at the lowest.
    """
    samples = best_sampled(ensemble, "g_nonaffine", "g_nonaffine_loaded")
    phis = samples.phis("g_nonaffine")
    zeros = {phi: _zero(samples, phi) for phi in phis if _ends_around_two(samples, phi)}
    parts = {
        "k_T/k_N on both sides of 2": [
            Part(f"crossing at {label(phi)}", zero, *CROSSING_RANGE) for phi, zero in zeros.items()
        ],
        "two area fractions": [
            _growth(samples, kappa, phis) for kappa in _ends(samples, phis) if len(phis) > 1
        ],
    }
    return Outcome(parts, f"{_crossings(zeros)} {_loading(samples)}")


def _ends(samples: Samples, phis: list[float]) -> list[float]:
    """The smallest and the largest k_T with samples at the lowest and at the highest φ."""
    kappas = samples.common_kappas("g_nonaffine", (phis[0], phis[-1]))
    return [kappas[0], kappas[-1]] if kappas else []


def _ends_around_two(samples: Samples, phi: float) -> bool:
    kappas = samples.kappas("g_nonaffine", phi, ABOVE_ZERO)
    return bool(kappas) and kappas[0] < CROSSING_RANGE[0] and kappas[-1] > CROSSING_RANGE[1]


def _zero(samples: Samples, phi: float) -> Estimate:
    kappas = samples.kappas("g_nonaffine", phi, ABOVE_ZERO)
    rows = np.array([samples.values("g_nonaffine", phi, kappa) for kappa in kappas])
    return crossing(np.array(kappas), rows.T)


def _growth(samples: Samples, kappa: float, phis: list[float]) -> Part:
    low, high = (np.abs(samples.values("g_nonaffine", phi, kappa)) for phi in (phis[0], phis[-1]))
    return Part(f"growth at {label(kappa=kappa)}", relative_difference(high, low), 0.0)


def _crossings(zeros: dict[float, Estimate]) -> str:
    listed = ", ".join(f"{zero} at {label(phi)}" for phi, zero in zeros.items())
    return f"The unloaded G_NA crosses 0 at κ = {listed}."


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
