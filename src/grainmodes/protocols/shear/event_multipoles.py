"""How the rotations of an event are arranged around its centre: B, Fig. 6.

The centre is the grain that moves farthest. With the polar angle ϑ_i of grain i around it,

    p_m = |Σ_i Δℓ̊_i e^{imϑ_i}|² / (Σ_i |Δℓ̊_i|)²         grains within L/2 of the centre

lies between 0 and 1. Four domains that turn in alternate senses, Δℓ̊ ∝ cos 2ϑ, have p_2 = 0.62 and
no other p_m; rotations at random have p_m ~ 1/N.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.kernels.neighbours import FRACTION_UNIT
from grainmodes.packing.state import Packing

QUADRUPOLE = 2
"""m of four domains."""

OTHER_MULTIPOLES = (1, 3, 4)
"""m with which p_2 is compared."""


PERMUTATIONS = 199
"""Number of permutations of the rotations; an event of no order has a rank below 0.05 in 5 %."""


class Multipoles(NamedTuple):
    """p_2 of an event, the mean of p_1, p_3 and p_4, and the rank of p_2; NaN: no grain turns.

    The rank is the share of permutations of the rotations among the grains, the true one included,
    that have a p_2 as large.
    """

    quadrupole: float
    others: float
    rank: float


def rotational_multipoles(packing: Packing, displacement: np.ndarray) -> Multipoles:
    """The multipoles of an event.

    Args:
        packing: the state after the event.
        displacement: (Δr̊, Δℓ̊) of every grain, (N, 3) in d; (N, 2) without friction.
    """
    if displacement.shape[1] < 3:
        return Multipoles(np.nan, np.nan, np.nan)
    centre = np.argmax(np.hypot(displacement[:, 0], displacement[:, 1]))
    s_x, s_y = (packing.fraction - packing.fraction[:, [centre]]) * FRACTION_UNIT
    x, y = (s_x + packing.strain * s_y) * packing.box_length, s_y * packing.box_length
    distance = np.hypot(x, y)
    near = (distance > 0.0) & (distance < 0.5 * packing.box_length)
    angle, turn = np.arctan2(y[near], x[near]), displacement[near, 2]
    total = np.abs(turn).sum()
    if total == 0.0:
        return Multipoles(np.nan, np.nan, np.nan)
    multipole = {
        m: np.abs(turn @ np.exp(1j * m * angle)) ** 2 / total**2
        for m in (QUADRUPOLE, *OTHER_MULTIPOLES)
    }
    others = np.mean([multipole[m] for m in OTHER_MULTIPOLES])
    shuffled = np.tile(turn, (PERMUTATIONS, 1))
    shuffled = np.random.default_rng(0).permuted(shuffled, axis=1)
    by_chance = np.abs(shuffled @ np.exp(1j * QUADRUPOLE * angle)) ** 2 / total**2
    as_large = np.count_nonzero(by_chance >= multipole[QUADRUPOLE])
    rank = (1 + as_large) / (1 + PERMUTATIONS)
    return Multipoles(float(multipole[QUADRUPOLE]), float(others), rank)
