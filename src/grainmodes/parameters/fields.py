"""Fields and single eigenvectors: which are kept, and up to which N."""

from __future__ import annotations

TRANSLATIONAL_FREQUENCIES = (1.3e-2, 1.0)
"""ω t_0 of A, Fig. 7, that does not depend on k_T."""

MOST_FOR_ALL_MODES = 2048
"""Grains up to which the modes of a sample are summed: A's Fig. 3 has 1024; 4096 take minutes."""


def field_frequencies(kt: float) -> tuple[float, ...]:
    """Frequencies in 1/t_0 whose eigenvectors are kept at k_T/k_N: those of A, Fig. 7.

    ω_R = (k_T/k_N)^(1/2) lies in the band of rotations, 1.3e-2 at the lower end of the translations
    of 4096 grains, 1 in their middle.

    >>> field_frequencies(1e-8)
    (0.0001, 0.013, 1.0)
    """
    return tuple(sorted({kt**0.5, *TRANSLATIONAL_FREQUENCIES} - {0.0}))
