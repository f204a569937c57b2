"""The Jacobian J = −∂F̃/∂q, sparse, for any law and any tangential displacement: A (18).

Every contact contributes its stiffness K (`kernels.contacts`) four times. The signs are those of
the two grains in the relative coordinates d r⃗ = d r⃗_i − d r⃗_j, dℓ = dℓ_i + dℓ_j, and of the force
on j for a given force on i:

    J_ii ← −K,   J_ij ← −K·diag(−,−,+),   J_ji ← −diag(−,−,+)·K,   J_jj ← −diag(−,−,+)·K·diag(−,−,+)

Degrees of freedom are ordered (x, y, ℓ) grain by grain; (x, y) where friction does not exist.
J is symmetric if every s = 0; otherwise it may have complex pairs of eigenvalues.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from grainmodes.kernels.assembly import jacobian_columns
from grainmodes.kernels.contacts import contact_stiffness, normal_stiffness
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import SIGNS, is_frictionless
from grainmodes.packing.state import Packing


def stiffness_of(contacts: Contacts, interaction: Interaction) -> np.ndarray:
    """K of every contact, (C, 3, 3) in k_N d^(1/2); (C, 2, 2) without friction."""
    if is_frictionless(interaction):
        return normal_stiffness(interaction, contacts.normal, contacts.distance, contacts.overlap)
    return contact_stiffness(
        interaction,
        contacts.normal,
        contacts.distance,
        contacts.overlap,
        contacts.spring_state,
    )


def jacobian(packing: Packing, interaction: Interaction) -> sparse.csc_array:
    """J of a packing, (kN, kN) in k_N d^(1/2), with k = 3, or 2 without friction: A (18).

    Raises:
        PackingError: two grains lie at the same place.
    """
    contacts = packing.contacts
    return assemble(stiffness_of(contacts, interaction), contacts.i, contacts.j, packing.n)


def assemble(stiffness: np.ndarray, i: np.ndarray, j: np.ndarray, n: int) -> sparse.csc_array:
    """The sparse matrix (kn, kn) of contact stiffnesses (C, k, k) between n grains.

    Args:
        i, j: (C,) int32, the grains of the contacts: i > j, sorted by (i, j).
    """
    k = stiffness.shape[1]
    entries = jacobian_columns(stiffness, SIGNS[:k], i, j, n)
    return sparse.csc_array(entries, shape=(k * n, k * n))
