"""Packings to try settings on, and how far two ensembles of them lie apart."""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Hertz
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression
from grainmodes.protocols.compression.trajectory import compress_to, place_at_random

HERTZ = Hertz(1.0)

COARSE = Compression(phi_step=1e-3)
"""A tenth of the steps of a study: seconds instead of a minute."""


def compressed(n: int, seed: int, phi: float, protocol: Compression = COARSE) -> Packing:
    """A Hertzian packing at φ in its final balance.

    Raises:
        CompressionError: it did not get there.
        ArithmeticError: its last balance was not found.
    """
    relaxed = compress_to(place_at_random(n, seed, HERTZ, protocol), phi, HERTZ, protocol)
    if not relaxed.converged:
        raise ArithmeticError(f"N = {n}, seed {seed}: max|F| = {relaxed.max_force:.1e}")
    return relaxed.packing


def shift_of_mean(found: np.ndarray, exact: np.ndarray) -> tuple[float, float]:
    """Bound (m² + e²)^(1/2) of the mean of x − x_ref, and e, both / σ; of (S,) samples."""
    unit, difference = exact.std(ddof=1), found - exact
    error = difference.std(ddof=1) / np.sqrt(len(found))
    return float(np.hypot(difference.mean(), error) / unit), float(error / unit)
