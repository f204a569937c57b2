"""How many seeds a relative standard error needs, estimated from a pilot of k seeds.

The standard error of a mean m over S seeds is σ / S^(1/2), so that ε = σ / (|m| S^(1/2)) needs

    S = (σ / (ε m))².                                                                          (1)

The pilot gives the estimate s² of σ². For normal samples (k − 1) s²/σ² follows χ² with k − 1
degrees of freedom, so that with probability `CONFIDENCE`

    (k − 1) / χ²_high  ≤  σ²/s²  ≤  (k − 1) / χ²_low.                                          (2)

With eight seeds this is 0.44 to 4.1 times the number of (1). The error of m is not in (2): it
changes S by twice its own relative size, s / (|m| k^(1/2)), which a plan states as `error`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.stats import chi2

CONFIDENCE = 0.95
"""Probability with which the interval contains the number of seeds that is needed."""

MIN_SEEDS = 2
"""Number of seeds below which there is no standard error."""


class SeedEstimate(NamedTuple):
    """Seeds by (1), the interval from `low` to `high` by (2), and the relative error of the pilot.

    Arrays of one shape, float, because a number of seeds may exceed every integer type.
    """

    seeds: np.ndarray
    low: np.ndarray
    high: np.ndarray
    error: np.ndarray


def seeds_needed(values: np.ndarray, target: float) -> SeedEstimate:
    """Seeds for the relative standard error `target` of the mean.

    Args:
        values: (k, ...) float, a row per pilot seed.
        target: above 0, such as 0.01 for 1 %.

    Returns:
        arrays (...).

    Raises:
        ValueError: there are fewer than two rows, or a mean is 0.
    """
    size = len(values)
    if size < MIN_SEEDS:
        raise ValueError(
            f"the spread over seeds: expected at least {MIN_SEEDS} converged seeds, got {size}"
        )
    mean = np.mean(values, axis=0)
    if np.any(mean == 0.0):
        raise ValueError("the mean is 0 and has no relative error")
    relative = np.var(values, axis=0, ddof=1) / mean**2
    below, above = (1.0 - CONFIDENCE) / 2.0, (1.0 + CONFIDENCE) / 2.0
    factors = [1.0, *((size - 1) / chi2.ppf([above, below], size - 1))]
    seeds, low, high = (_whole(relative / target**2 * factor) for factor in factors)
    return SeedEstimate(seeds, low, high, np.sqrt(relative / size))


def _whole(seeds: np.ndarray) -> np.ndarray:
    # Round-off may leave a number slightly above the integer that it equals.
    return np.maximum(np.ceil(seeds * (1.0 - 1e-12)), MIN_SEEDS)
