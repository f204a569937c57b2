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
