"""Several tests at once."""

from __future__ import annotations

import numpy as np


def holm(p_values: np.ndarray) -> np.ndarray:
    """The p-values (K,) corrected by Holm for the number of tests, in the order given.

    With p_(1) <= ... <= p_(K), the corrected one is max over j <= k of (K - j + 1) p_(j), at most
    1. If those up to a level are taken for real, the probability that any of them is due to chance
    is at most the level, however the tests depend on each other.
    """
    order = np.argsort(p_values, kind="stable")
    remaining = len(p_values) - np.arange(len(p_values))
    corrected = np.minimum(np.maximum.accumulate(remaining * p_values[order]), 1.0)
    return corrected[np.argsort(order, kind="stable")]
