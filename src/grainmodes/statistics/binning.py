"""The bins of frequency of paper A, and the modes that fall into each.

A, Sec. IV B: the range of the data is divided into 50 logarithmic intervals; the range of the ten
highest is divided anew into 500 linear ones, and last the part of the range within
0.1 omega_R < omega < 2 omega_R, omega_R t_0 = (k_T / k_N)^(1/2), into 100 linear ones.

`BinnedModes` is the form of every spectrum that a figure shows, whether its modes are known one by
one or were counted in bins with averages of psi^R and p.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.parameters.spectra import (
    HIGHEST_BINS,
    HIGHEST_DIVISIONS,
    LOGARITHMIC_BINS,
    ROTATIONAL_DIVISIONS,
)

ROTATIONAL_WINDOW = (0.1, 2.0)
"""Range of omega / omega_R that is divided linearly."""

LOWEST_EDGE = 0.01
"""First edge of counted bins, in omega_R."""

LOWEST_SAFE_EDGE = 1e-7
"""Lowest omega t_0 at which a count distinguishes a vibration from a zero mode."""

HIGHEST_EDGE = 2.5
"""Last edge of counted bins at k_T = 0, 1/t_0; the stiffest Hertzian mode lies near 1.4, the
stiffest harmonic one, and that of the effective Hessian as printed, near 2.4."""


class BinSums(NamedTuple):
    """Sums of a number per mode over the modes of each bin, with the error stated for each.

    `total` is NaN where the number is not known, `error` 0 where the sum is exact; both
    are (B,) for one sample of B bins, or (S, B) for S samples.
    """

    total: np.ndarray
    error: np.ndarray


class BinnedModes(NamedTuple):
    """The modes of S samples in B bins.

    `edges` (B + 1,), 1/t_0; `count` (S, B) modes of each sample in each bin; `outside` (S,) modes
    in no bin: zero, negative, below the first or above the last.
    """

    edges: np.ndarray
    count: np.ndarray
    outside: np.ndarray
    psi_rotational: BinSums
    participation_ratio: BinSums

    def in_bins(self, edges: np.ndarray) -> BinnedModes:
        """Return itself whatever `edges`, because counts cannot be divided into other bins."""
        return self


def bin_edges(kappa: float, lowest: float, highest: float, bin_density: float = 1.0) -> np.ndarray:
    """The edges of A's bins over the range of the data.

    Args:
        kappa: k_T / k_N; 0 has no rotational window.
        lowest, highest: 1/t_0, 0 < lowest < highest, the range of the data.
        bin_density: factor on the numbers 500 and 100, for ensembles of fewer modes than A's.

    Returns:
        (B + 1,) ascending; the first is `lowest`, the last `highest`.

    Raises:
        ValueError: not 0 < lowest < highest.
    """
    if not 0.0 < lowest < highest:
        raise ValueError(f"bins from {lowest} to {highest}: expected 0 < lowest < highest")
    edges = np.geomspace(lowest, highest, LOGARITHMIC_BINS + 1)
    edges = _redivided(edges, edges[-1 - HIGHEST_BINS], highest, bin_density * HIGHEST_DIVISIONS)
    start, stop = np.sqrt(kappa) * np.array(ROTATIONAL_WINDOW)
    start, stop = max(start, lowest), min(stop, highest)
    if start < stop:
        edges = _redivided(edges, start, stop, bin_density * ROTATIONAL_DIVISIONS)
    return edges


def fixed_edges(kappa: float, bin_density: float) -> np.ndarray:
    """A's bins over a range that depends on the point alone, for spectra that are counted in bins.

    They reach from 0.01 omega_R, at most 1e-3 and at least the lowest safe edge 1e-7, to beyond the
    stiffest mode of usual packings, 2.5 (1 + kappa)^(1/2). Modes outside are counted too.

    Returns:
        (B + 1,) 1/t_0, ascending.
    """
    lowest = np.clip(LOWEST_EDGE * np.sqrt(kappa), LOWEST_SAFE_EDGE, 1e-3) if kappa > 0.0 else 1e-3
    return bin_edges(kappa, lowest, HIGHEST_EDGE * np.sqrt(1.0 + kappa), bin_density)


def _redivided(edges: np.ndarray, start: float, stop: float, divisions: float) -> np.ndarray:
    linear = np.linspace(start, stop, max(1, round(divisions)) + 1)
    return np.concatenate([edges[edges < start], linear, edges[edges > stop]])


def bin_modes(
    frequency: np.ndarray,
    modes: np.ndarray,
    psi_rotational: np.ndarray,
    participation_ratio: np.ndarray,
    edges: np.ndarray,
) -> BinnedModes:
    """Put modes that are known one by one into bins.

    Args:
        frequency: (S, M) 1/t_0, NaN where there is no vibration.
        modes: (S,) modes of each sample, those without a frequency included.
        psi_rotational, participation_ratio: (S, M); NaN where they are not known.
        edges: (B + 1,) 1/t_0.
    """
    count = occupation(frequency, edges)
    exact = np.zeros_like(count)
    psi, participation = (
        BinSums(occupation(frequency, edges, weight), exact)
        for weight in (psi_rotational, participation_ratio)
    )
    return BinnedModes(edges, count, modes - count.sum(axis=1), psi, participation)


def bin_centres(edges: np.ndarray) -> np.ndarray:
    """Geometric middle of each bin, (B,): the middle on the logarithmic axes of the figures."""
    return np.sqrt(edges[:-1] * edges[1:])


def occupation(
    frequency: np.ndarray, edges: np.ndarray, weight: np.ndarray | None = None
) -> np.ndarray:
    """Modes of each sample in each bin, or the sum of their weights.

    Args:
        frequency: (S, M) 1/t_0, NaN where there is no vibration.
        edges: (B + 1,) 1/t_0; the last bin includes its upper edge.
        weight: (S, M), a number per mode; None counts the modes.

    Returns:
        (S, B) float.
    """
    weight = np.ones_like(frequency) if weight is None else weight
    rows = [
        np.histogram(row[np.isfinite(row)], edges, weights=weights[np.isfinite(row)])[0]
        for row, weights in zip(frequency, weight, strict=True)
    ]
    return np.array(rows).reshape(len(frequency), len(edges) - 1)
