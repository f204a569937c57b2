"""The energy that a contact stores: the work of its normal force since first touch, and of its
tangential force from s = 0 on, at the present overlap. Each law implements its own (`laws`).

Only without friction, and for harmonic elastic contacts, are the contact forces the gradient of
this energy.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.contacts import spring_at
from grainmodes.kernels.laws import normal_energy, tangential_energy


@kernel
def contact_energies(interaction, overlap, spring_state):
    """Energy of every contact, (C,) in k_N d^(5/2) (Hertz) or k_N d² (harmonic)."""
    energy = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        energy[c] = normal_energy(interaction.normal, overlap[c]) + tangential_energy(
            interaction.tangential, interaction.normal, overlap[c], spring_at(spring_state, c)
        )
    return energy
