"""Numbers that take a whole curve of samples: κ*, where G_NA changes its sign, and the exponent β.

| symbol | meaning                                       | from                                   |
| ------ | --------------------------------------------- | -------------------------------------- |
| κ*(φ)  | k_T/k_N at which <G_NA> rises through 0       | `g_nonaffine`: unloaded step, A (41)   |
| β(κ)   | G ∝ (φ − φ_J)^β, φ_J that of the sample       | `g`, `phi_jamming`                     |

Both pair the samples: the packings of one seed are the same at every k_T, and φ_J is that of the
seed. Errors are those of the jackknife and of the mean over seeds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.ensemble.reading import variable
from grainmodes.statistics.estimates import Estimate, crossing, jackknife, logarithm, mean

if TYPE_CHECKING:
    import xarray as xr

MIN_AREA_FRACTIONS = 3
"""Smallest number of area fractions for an exponent."""


def jammed_values(ensemble: xr.Dataset, name: str, n: int) -> xr.DataArray:
    """A number per sample at one N, (phi, kt, seed), NaN where a sample is not jammed.

    Raises:
        BlockError: the ensemble lacks it.
    """
    rows, converged, jammed = (
        variable(ensemble, word).sel(n=n) for word in (name, "converged", "jammed")
    )
    return rows.where((converged == 1) & (jammed == 1)).transpose("phi", "kt", "seed")


def crossing_samples(ensemble: xr.Dataset, n: int, phi: float) -> tuple[np.ndarray, np.ndarray]:
    """The k_T/k_N > 0 (K,) at which G_NA is known at one φ, and G_NA (S, K) of the samples."""
    rows = jammed_values(ensemble, "g_nonaffine", n).sel(phi=phi)
    rows = rows.sel(kt=rows["kt"] > 0.0).dropna("kt", how="all")
    return rows["kt"].to_numpy(), rows.transpose("seed", "kt").to_numpy()


def sign_change(ensemble: xr.Dataset, n: int, phi: float) -> Estimate | None:
    """κ* at one φ, linear in log κ between the points; None if <G_NA> does not rise through 0."""
    kappas, rows = crossing_samples(ensemble, n, phi)
    if len(kappas) < 2:
        return None
    means = np.nanmean(rows, axis=0)
    return crossing(kappas, rows) if means[0] < 0.0 < means[-1] else None


def sign_changes(ensemble: xr.Dataset, n: int, min_samples: int) -> dict[float, Estimate]:
    """φ → κ*, φ ascending, where at least so many samples stand behind it."""
    found = {phi: sign_change(ensemble, n, phi) for phi in ensemble["phi"].to_numpy().tolist()}
    return {
        phi: zero for phi, zero in found.items() if zero is not None and zero.samples >= min_samples
    }


def exponents(ensemble: xr.Dataset, n: int, kappa: float) -> tuple[np.ndarray, int]:
    """β of every seed (S,) at one k_T, NaN with fewer than three φ; and the samples with G ≤ 0."""
    moduli = jammed_values(ensemble, "g", n).sel(kt=kappa)
    distance = moduli["phi"] - jammed_values(ensemble, "phi_jamming", n).sel(kt=kappa)
    (x, _), (y, dropped) = (logarithm(rows.to_numpy()) for rows in (distance, moduli))
    return np.array([_slope(*column) for column in zip(x.T, y.T, strict=True)]), dropped


def exponent(ensemble: xr.Dataset, n: int, kappa: float) -> Estimate:
    """Mean of β over the seeds at one k_T."""
    slopes, dropped = exponents(ensemble, n, kappa)
    return mean(slopes)._replace(left_out=dropped)


def exponent_between(
    ensemble: xr.Dataset, n: int, kappa: float, low: float, high: float
) -> Estimate:
    """d log <G> / d log <φ − φ_J> between two φ, which shows whether a power law is one."""
    names = ("g", "phi_jamming")
    rows = [
        jammed_values(ensemble, name, n).sel(kt=kappa, phi=phi).to_numpy()
        for phi in (low, high)
        for name in names
    ]

    def slope(g: np.ndarray, jamming: np.ndarray, g_high: np.ndarray, high_j: np.ndarray) -> float:
        distances = (high - high_j.mean()) / (low - jamming.mean())
        with np.errstate(invalid="ignore", divide="ignore"):
            return float(np.log(g_high.mean() / g.mean()) / np.log(distances))

    return jackknife(slope, *rows)


def _slope(x: np.ndarray, y: np.ndarray) -> float:
    known = np.isfinite(x) & np.isfinite(y)
    return np.polyfit(x[known], y[known], 1)[0] if known.sum() >= MIN_AREA_FRACTIONS else np.nan
