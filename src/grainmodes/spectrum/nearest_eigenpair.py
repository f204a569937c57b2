"""The one eigenpair nearest to σ, also where σ lies in a gap of the spectrum.

Between two bands all eigenvalues of a band are at nearly the same distance from σ, and a Krylov
space of (J − σ)⁻¹ does not tell them apart: at k_T/k_N = 1e-8 the rotational band ends near 1e-7
k_N d^(1/2), and the translational band begins above 1e-3. The nearest eigenvalue is then one of the
two edges of the gap. Inertia counts locate both edges, and the pair is found from the nearer one.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from grainmodes.linalg.block_lanczos import Eigenpairs
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.spectrum.slice_eigenpairs import SliceError, nearest_eigenpairs

MIN_EIGENVALUE = 1e-14
"""Eigenvalue, k_N d^(1/2), below which a count cannot tell a mode from a zero mode."""

EDGE_WIDTH = 1e-3
"""Relative width to which an edge of a gap is bracketed."""


def nearest_eigenpair(shift: SymmetricShift, sigma: float, bound: float) -> Eigenpairs:
    """The eigenpair nearest to σ > 0, without the known zero modes.

    Args:
        shift: of J; its factors are replaced.
        sigma: σ in k_N d^(1/2).
        bound: a bound on the largest eigenvalue of J, k_N d^(1/2).

    Returns:
        λ (1,) and R (M, 1).

    Raises:
        SliceError: no eigenpair converged.
        ZeroPivotError: J − σ is singular however σ is changed.
    """
    try:
        return nearest_eigenpairs(shift, sigma, 1)
    except SliceError:
        edges = [*_edges_of_gap(shift, sigma, bound)]
        if not edges:
            raise
    nearest_edge = min(edges, key=lambda edge: abs(edge - sigma))
    return nearest_eigenpairs(shift, nearest_edge, 1)


def _edges_of_gap(shift: SymmetricShift, sigma: float, bound: float) -> Iterator[float]:
    """The nearest eigenvalues below and above σ, each to `EDGE_WIDTH`, without zero modes."""
    n_below = shift.factor_at(sigma).n_below
    for factor, end in ((0.1, MIN_EIGENVALUE), (10.0, max(bound, sigma))):
        low, high = sorted((sigma, end))
        inside = outside = sigma
        while outside != end and shift.factor_at(outside).n_below == n_below:
            inside, outside = outside, float(np.clip(factor * outside, low, high))
        if shift.factor_at(outside).n_below == n_below:
            continue  # no eigenvalue on this side of σ
        while abs(outside - inside) > EDGE_WIDTH * inside:
            middle = float(np.sqrt(inside * outside))
            if shift.factor_at(middle).n_below == n_below:
                inside = middle
            else:
                outside = middle
        yield outside
