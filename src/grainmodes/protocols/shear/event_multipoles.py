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

OTHER_MULTIPOLES = (1, 3, 4)
"""m with which p_2 is compared."""


def rotational_multipoles(packing: Packing, displacement: np.ndarray) -> tuple[float, float]:
    """p_2 of an event, and the mean of p_1, p_3 and p_4; NaN where no grain turns.

    Args:
        packing: the state after the event.
        displacement: (Δr̊, Δℓ̊) of every grain, (N, 3) in d; (N, 2) without friction.
    """
    if displacement.shape[1] < 3:
        return np.nan, np.nan
    centre = np.argmax(np.hypot(displacement[:, 0], displacement[:, 1]))
    s_x, s_y = (packing.fraction - packing.fraction[:, [centre]]) * FRACTION_UNIT
    x, y = (s_x + packing.strain * s_y) * packing.box_length, s_y * packing.box_length
    distance = np.hypot(x, y)
    near = (distance > 0.0) & (distance < 0.5 * packing.box_length)
    angle, turn = np.arctan2(y[near], x[near]), displacement[near, 2]
    total = np.abs(turn).sum()
    if total == 0.0:
        return np.nan, np.nan
    multipole = {
        m: np.abs(turn @ np.exp(1j * m * angle)) ** 2 / total**2
        for m in (QUADRUPOLE, *OTHER_MULTIPOLES)
    }
    others = np.mean([multipole[m] for m in OTHER_MULTIPOLES])
    return float(multipole[QUADRUPOLE]), float(others)
