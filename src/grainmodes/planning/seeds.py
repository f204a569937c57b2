"""How many seeds a relative standard error takes, from a pilot of k of them.

The standard error of a mean m over S seeds is σ / S^(1/2), so that ε = σ / (|m| S^(1/2)) takes

    S = (σ / (ε m))².                                                                          (1)

The pilot knows σ² by its estimate s². For normal samples (k − 1) s²/σ² follows χ² with k − 1
degrees of freedom, so that with probability `CONFIDENCE`

    (k − 1) / χ²_high  ≤  σ²/s²  ≤  (k − 1) / χ²_low.                                          (2)

Eight seeds leave 0.44 to 4.1 times the number of (1). The error of m is not in (2): it moves S by
twice its own relative size, s / (|m| k^(1/2)), which stands beside the plan as `error`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.stats import chi2

CONFIDENCE = 0.95
"""Probability with which the interval holds the number of seeds."""

LEAST = 2
"""Seeds below which there is no standard error."""


class Need(NamedTuple):
    """Seeds by (1) and from `low` to `high` by (2); `error`: relative standard error of the pilot.

    Arrays of one shape, float: a number of seeds may be beyond all integers.
    """

    seeds: np.ndarray
    low: np.ndarray
    high: np.ndarray
    error: np.ndarray


def needed(values: np.ndarray, target: float) -> Need:
    """Seeds for the relative standard error `target` of the mean.

    Args:
        values: (k, ...) float, a row per pilot seed.
        target: above 0, as 0.01 for 1 %.

    Returns:
        arrays (...).

    Raises:
        ValueError: there are fewer than two rows, or a mean is 0.
    """
    size = len(values)
    if size < LEAST:
        raise ValueError(
            f"the spread over seeds: expected at least {LEAST} converged seeds, got {size}"
        )
    mean = np.mean(values, axis=0)
    if np.any(mean == 0.0):
        raise ValueError("the mean is 0 and has no relative error")
    relative = np.var(values, axis=0, ddof=1) / mean**2
    below, above = (1.0 - CONFIDENCE) / 2.0, (1.0 + CONFIDENCE) / 2.0
    factors = [1.0, *((size - 1) / chi2.ppf([above, below], size - 1))]
    return Need(*(_whole(relative / target**2 * of) for of in factors), np.sqrt(relative / size))


def _whole(seeds: np.ndarray) -> np.ndarray:
    # Rounding may leave a number just above the whole one that it stands for.
    return np.maximum(np.ceil(seeds * (1.0 - 1e-12)), LEAST)
