"""Rattlers out of the way: they carry no load, and a balance needs them to touch nothing."""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.contacts import normal_slope
from grainmodes.kernels.laws import Frictionless, Interaction
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import net_force
from grainmodes.packing.state import Packing, find_contacts

TRIES = 100
"""Moves after which a rattler is left touching: it may be caught between two neighbours."""


def moved_out(packing: Packing, normal, gone: np.ndarray) -> Packing:
    """The packing with the rattlers of a (N,) mask moved by their normal forces until free.

    Three halves of the Newton step F/Σf_N' takes a lone Hertz contact exactly to zero overlap.
    """
    interaction = Interaction(normal, Frictionless())
    for _ in range(TRIES):
        contacts = find_contacts(packing)
        if not np.any(gone[contacts.i] | gone[contacts.j]):
            break
        force = net_force(packing, contacts, interaction)
        stiffness = _grain_stiffness(contacts, normal, packing.n)
        step = 1.5 * force / np.where(stiffness > 0.0, stiffness, 1.0)[:, None]
        packing = packing.displaced(np.where(gone[:, None], step, 0.0))
    return packing


def _grain_stiffness(contacts: Contacts, normal, n: int) -> np.ndarray:
    """Σ_j f_N'(ξ_ij) of every grain, (N,)."""
    slope = normal_slope(normal, contacts.overlap)
    return np.bincount(contacts.i, slope, n) + np.bincount(contacts.j, slope, n)
