"""How the rotations of an event are arranged around its centre: B, Fig. 6.

The centre is the grain that moves farthest. With the polar angle ϑ_i of grain i around it,

    p_m = |Σ_i Δℓ̊_i e^{imϑ_i}|² / (Σ_i |Δℓ̊_i|)²         grains within L/2 of the centre

lies between 0 and 1. Four domains that turn in alternate senses, Δℓ̊ ∝ cos 2ϑ, have p_2 = 0.62 and
no other p_m; rotations at random have p_m ~ 1/N.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.neighbours import FRACTION_UNIT
from grainmodes.packing.state import Packing

QUADRUPOLE = 2
"""m of four domains."""

OTHERS = (1, 3, 4)
"""m that p_2 is held against."""


def rotational_poles(packing: Packing, displacement: np.ndarray) -> tuple[float, float]:
    """p_2 of an event, and the mean of p_1, p_3 and p_4; NaN where nothing turns.

    Args:
        packing: the state after it.
        displacement: (Δr̊, Δℓ̊) of every grain, (N, 3) in d; (N, 2) where friction does not exist.
    """
    if displacement.shape[1] < 3:
        return np.nan, np.nan
    centre = np.argmax(np.hypot(displacement[:, 0], displacement[:, 1]))
    apart = _from(packing, centre)
    distance = np.hypot(apart[:, 0], apart[:, 1])
    near = (distance > 0.0) & (distance < 0.5 * packing.box_length)
    angle, turn = np.arctan2(apart[near, 1], apart[near, 0]), displacement[near, 2]
    whole = np.abs(turn).sum()
    if whole == 0.0:
        return np.nan, np.nan
    pole = {m: np.abs(turn @ np.exp(1j * m * angle)) ** 2 / whole**2 for m in (QUADRUPOLE, *OTHERS)}
    return float(pole[QUADRUPOLE]), float(np.mean([pole[m] for m in OTHERS]))


def _from(packing: Packing, grain: int) -> np.ndarray:
    """r⃗ of every grain from one of them, the nearest image, (N, 2) in d."""
    s_x, s_y = (packing.fraction - packing.fraction[:, [grain]]) * FRACTION_UNIT
    return np.stack([s_x + packing.strain * s_y, s_y], axis=1) * packing.box_length
