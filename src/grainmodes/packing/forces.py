"""Net forces, stress and energy of a packing.

    F_i = Σ_j f_ij,   scaled torque 2 T_i / d_i = Σ_j f_T,ij          A (3)–(5), J of physics: F̃_i
    σ_αβ = −(1/L²) Σ_{i<j} f^α_ij r^β_ij                              A (14)

Units are those of Hertzian grains; for harmonic grains forces are in k_N d and stresses in k_N.
Without friction torque does not exist: forces on N grains are then (N, 2), and (N, 3) otherwise.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.assembly import sum_on_grains
from grainmodes.kernels.contacts import contact_forces, normal_forces
from grainmodes.kernels.energies import contact_energies
from grainmodes.kernels.lanes import lane_sum
from grainmodes.kernels.laws import SLIDING_FRACTION, Frictionless, Interaction
from grainmodes.kernels.springs import slip_thresholds
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.state import Packing

SIGNS = np.array([-1.0, -1.0, 1.0])
"""Signs with which (x, y, ℓ) of grain j enter relative coordinates, and forces act on it."""


def is_frictionless(interaction: Interaction) -> bool:
    """Whether the interaction has no tangential part."""
    return isinstance(interaction.tangential, Frictionless)


def forces_on_i(contacts: Contacts, interaction: Interaction) -> np.ndarray:
    """(f_x, f_y, f_T) of every contact on its grain i, (C, 3) in k_N d^(3/2): A (3), (7), (8).

    Without friction (f_x, f_y), (C, 2).
    """
    if is_frictionless(interaction):
        return normal_forces(interaction, contacts.normal, contacts.overlap)
    s = contacts.spring_state
    return contact_forces(interaction, contacts.normal, contacts.overlap, s)


def tangential_forces(interaction: Interaction, overlap: np.ndarray, s: np.ndarray) -> np.ndarray:
    """f_T of contacts with these overlaps in d and spring states, all (C,), in k_N d^(3/2)."""
    along_x = np.tile([1.0, 0.0], (len(s), 1))
    return contact_forces(interaction, along_x, overlap, s)[:, 2]


def sliding(contacts: Contacts, interaction: Interaction) -> np.ndarray:
    """Contacts at Coulomb's threshold, |s| ≥ s* = μ (k_N/k_T) ξ or |h| ≥ μ f_N: (C,) bool; C (8).

    All are False without friction, or with springs that never slip.
    """
    slides_at = slip_thresholds(interaction, contacts.overlap)
    return np.abs(contacts.springs) >= SLIDING_FRACTION * slides_at


def net_force(packing: Packing, interaction: Interaction) -> np.ndarray:
    """F̃ = (F_x, F_y, 2 T/d) on every grain, (N, 3) in k_N d^(3/2): A (3)–(5).

    Without friction (F_x, F_y), (N, 2).

    Raises:
        PackingError: two grains lie at the same place.
    """
    contacts = packing.contacts
    return sum_over_contacts(contacts, forces_on_i(contacts, interaction), packing.n)


def sum_over_contacts(contacts: Contacts, forces: np.ndarray, n: int) -> np.ndarray:
    """Sum over the contacts of every grain, (N, k), of forces (C, k) on their grains i.

    Grain j of a contact receives the force times `SIGNS`.
    """
    return sum_on_grains(forces, SIGNS[: forces.shape[1]], contacts.i, contacts.j, n)


def max_force_and_torque(force: np.ndarray) -> tuple[float, float]:
    """(max|F|, max|2 T/d|) over the components of net forces (N, k); (…, 0) without friction."""
    if len(force) == 0:
        return 0.0, 0.0
    torque = float(np.abs(force[:, 2]).max()) if force.shape[1] == 3 else 0.0
    return float(np.abs(force[:, :2]).max()), torque


def stress(packing: Packing, interaction: Interaction) -> np.ndarray:
    """σ_αβ of a packing, (2, 2) in k_N d^(1/2): A (14).

    Raises:
        PackingError: two grains lie at the same place.
    """
    contacts = packing.contacts
    branch = contacts.normal * contacts.distance[:, None]
    forces = forces_on_i(contacts, interaction)[:, :2]
    return -(forces.T @ branch) / packing.box_length**2


def energy(packing: Packing, interaction: Interaction) -> float:
    """Energy stored in the contacts, in k_N d^(5/2) (Hertz) or k_N d²: see `kernels.energies`."""
    contacts = packing.contacts
    return lane_sum(contact_energies(interaction, contacts.overlap, contacts.spring_state))


def mean_contact_force(packing: Packing, interaction: Interaction) -> float:
    """Mean magnitude of the contact forces, k_N d^(3/2); 0 without contacts."""
    if len(packing.contacts.i) == 0:
        return 0.0
    forces = forces_on_i(packing.contacts, interaction)
    return lane_sum(np.sqrt(forces[:, 0] ** 2 + forces[:, 1] ** 2)) / len(forces)
