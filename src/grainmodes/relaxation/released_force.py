"""The tangential force that a contact releases when it opens."""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import tangential_forces
from grainmodes.packing.state import Packing

OPENING_OVERLAP = 1e-100
"""Overlap, in d, of a contact at the moment when it opens: small, but not zero."""


def force_released_on_opening(packing: Packing, interaction: Interaction) -> float:
    """Largest force, in k_N d^(3/2), that a contact of the history bore when it opened.

    It is the tangential force at zero overlap. It is zero where the tangential force ends with the
    normal one, for Hertzian contacts and under Coulomb's condition. A harmonic contact without slip
    releases k_T s at once.
    """
    contacts, history = packing.contacts, packing.history
    if history is None or len(history.i) == len(contacts.i):
        return 0.0
    opened = ~np.isin(history.key, contacts.key, assume_unique=True)
    s = history.spring_state[opened]
    overlap = np.full(len(s), OPENING_OVERLAP)
    return float(np.abs(tangential_forces(interaction, overlap, s)).max(initial=0.0))
