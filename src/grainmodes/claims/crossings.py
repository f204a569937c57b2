"""κ*, the k_T/k_N at which the unloaded G_NA changes its sign: noted in A6, measured in G1."""

from __future__ import annotations

import numpy as np

from grainmodes.claims.samples import ABOVE_ZERO, Samples
from grainmodes.statistics.estimates import Estimate, crossing


def zero_crossings(samples: Samples) -> dict[float, Estimate]:
    """φ → κ*, interpolated linearly in log k_T, with its error from the jackknife over seeds.

    At φ where the mean of G_NA is negative at the smallest and positive at the largest k_T > 0.
    """
    phis = samples.phis("g_nonaffine")
    found = {phi: _crossing(samples, phi) for phi in phis}
    return {phi: zero for phi, zero in found.items() if zero is not None}


def _crossing(samples: Samples, phi: float) -> Estimate | None:
    kappas = samples.kappas("g_nonaffine", phi, ABOVE_ZERO)
    if len(kappas) < 2:
        return None
    rows = np.array([samples.values("g_nonaffine", phi, kappa) for kappa in kappas])
    means = np.nanmean(rows, axis=1)
    return crossing(np.array(kappas), rows.T) if means[0] < 0.0 < means[-1] else None
