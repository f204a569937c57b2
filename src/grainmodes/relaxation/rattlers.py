"""Rattlers: which grains they are, and how they are moved until they touch nothing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grainmodes.kernels.contacts import normal_slope
from grainmodes.kernels.laws import Frictionless, Interaction, NormalLaw
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import is_frictionless, net_force
from grainmodes.packing.state import Packing

MAX_MOVES = 100
"""Moves after which a rattler is left where it is: it may be caught between two neighbours."""

STEP_FACTOR = 1.5
"""Length of a move in Newton steps F/Σf_N'.

Of a single Hertzian contact it reaches zero overlap exactly: f_N/f_N' = 2ξ/3."""


def rattler_threshold(interaction: Interaction) -> int:
    """Largest number of contacts of a grain that carries no load: 2, or 1 with friction.

    With friction two contacts may hold a grain.
    """
    return 2 if is_frictionless(interaction) else 1


def detach_rattlers(packing: Packing, normal: NormalLaw, is_rattler: NDArray[np.bool_]) -> Packing:
    """The packing with its rattlers moved along their normal forces until they touch nothing.

    A rattler carries no load, so that it must not touch anything in a force balance.

    Args:
        normal: the law of the normal force; friction is ignored.
        is_rattler: (N,) bool, the grains that may be moved.

    Raises:
        PackingError: two grains lie at the same place.
    """
    interaction = Interaction(normal, Frictionless())
    for _ in range(MAX_MOVES):
        contacts = packing.contacts
        if not np.any(is_rattler[contacts.i] | is_rattler[contacts.j]):
            break
        force = net_force(packing, interaction)
        stiffness = _grain_stiffness(contacts, normal, packing.n)
        step = STEP_FACTOR * force / np.where(stiffness > 0.0, stiffness, 1.0)[:, None]
        packing = packing.displaced(np.where(is_rattler[:, None], step, 0.0))
    return packing


def _grain_stiffness(contacts: Contacts, normal: NormalLaw, n: int) -> NDArray[np.float64]:
    """Σ_j f_N'(ξ_ij) of every grain, (N,) in k_N d^(1/2)."""
    slope = normal_slope(normal, contacts.overlap)
    total = np.bincount(contacts.i, slope, n) + np.bincount(contacts.j, slope, n)
    return np.asarray(total, np.float64)
