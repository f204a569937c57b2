"""The numbers behind "small", "large", "weak" and "equal" in paper A."""

from __future__ import annotations

SMALL_KAPPA = 1e-4
"""k_T/k_N up to which A finds no influence of k_T (Fig. 5)."""

LARGE_KAPPA = 1.0
"""k_T/k_N from which on A's bands are merged; what A calls "large" without giving a number."""

WEAK_KAPPA = 1e-8
"""k_T/k_N of A's Figs. 11, 15 and 16, and of the first rattlers of Fig. 14."""

TOLERANCE = 0.01
"""Relative difference of two moduli that is not visible in a figure of A."""

LOG_TOLERANCE = -2.0
"""log10 of it."""

MIN_PHI = 0.85
"""φ below which single packings decide a mean: their G is near 0, or below."""

MIN_GRAINS = 256
"""N below which single packings decide a mean at every φ."""

PAPER_GRAINS = 4096
"""N of A's spectra."""


def enough_grains(n: int, needed: int = MIN_GRAINS) -> str:
    """What is needed where a system has too few grains; empty where it has enough."""
    return f"N ≥ {needed}" if n < needed else ""
