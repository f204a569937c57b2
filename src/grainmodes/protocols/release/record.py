"""What is recorded while an unstable state moves: C (29), (30), Sec. VI B.

    M = ⟨|Δr_i|²⟩,   A = ⟨Δθ_i²⟩,   Δ against the start, θ_i = 2 ℓ_i / d_i              C (29), (30)
    P = −(σ_xx + σ_yy)/2 = Σ_i P_i,   P_i = Σ_j r_ij · f_ij / (4 L²)                    C, Fig. 10

A contact slides where |s| ≥ s* (C (8)). Stresses are those of the contacts alone; the kinetic
energy is recorded separately. Differences of positions are exact in the fractions, 2⁻⁶⁴ L, but the
forces feel the rounding of distances, 1e-16 d, so that M is meaningful above about 1e-30 d².
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import contact_changes
from grainmodes.packing.forces import forces_on_i, sliding, stress
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing, nonaffine_motion, rattlers
from grainmodes.relaxation.dynamics import Motion
from grainmodes.relaxation.rattlers import rattler_threshold


class MotionRecord(NamedTuple):
    """A moving state in numbers, or the means of several such records.

    | field                    | unit        | meaning                                          |
    | ------------------------ | ----------- | ------------------------------------------------ |
    | time                     | t_0         | time since the release                           |
    | mean_square_displacement | d²          | M                                                |
    | mean_square_rotation     | 1           | A                                                |
    | pressure, stress_xy, _yx | k_N d^(1/2) | P, σ_xy, σ_yx of the contacts                    |
    | contact_number           | 1           | 2 C / N over all grains                          |
    | sliding                  | 1           | number of contacts at Coulomb's threshold        |
    | changed                  | 1           | number of contacts by which the state differs    |
    |                          |             | from the start (`count_changed_contacts`)        |
    | kinetic_energy           | k_N d^(5/2) | Σ_i m_i (|ṙ_i|² + ℓ̇_i²/2)/2                     |
    """

    time: float
    mean_square_displacement: float
    mean_square_rotation: float
    pressure: float
    stress_xy: float
    stress_yx: float
    contact_number: float
    sliding: float
    changed: float
    kinetic_energy: float


def record_motion(
    time: float, motion: Motion, start: Packing, interaction: Interaction
) -> MotionRecord:
    """Record a moving packing that left `start`, a state at rest of the same grains."""
    packing, contacts = motion.packing, motion.packing.contacts
    displacement = nonaffine_motion(start, packing)
    sigma = stress(packing, interaction)
    return MotionRecord(
        time,
        float((displacement[:, :2] ** 2).sum(axis=1).mean()),
        float(((2.0 * displacement[:, 2] / packing.diameter) ** 2).mean()),
        -float(np.trace(sigma)) / 2.0,
        float(sigma[0, 1]),
        float(sigma[1, 0]),
        2.0 * len(contacts.i) / packing.n,
        int(sliding(contacts, interaction).sum()),
        count_changed_contacts(packing, start, interaction),
        0.5 * float((generalized_mass(packing.mass) * motion.velocity**2).sum()),
    )


def count_changed_contacts(packing: Packing, before: Packing, interaction: Interaction) -> int:
    """Number of contacts gained and lost between the grains that carried load before.

    Rattlers do not count: a rattler may begin to touch at any time, and bears no load.
    """
    in_backbone = ~rattlers(before, rattler_threshold(interaction))
    return contact_changes(*(state.contacts.among(in_backbone) for state in (before, packing)))


class GrainStress(NamedTuple):
    """How the contacts load the grains.

    `contacts` (N,) is the number of contacts of every grain, `pressure` (N,) its P_i in
    k_N d^(1/2), and `binary` (C,) the r_ij · f_ij of every contact in k_N d^(5/2).
    """

    contacts: np.ndarray
    pressure: np.ndarray
    binary: np.ndarray

    def pressure_by_contacts(self, max_z: int, min_grains: int) -> np.ndarray:
        """Mean P_i of the grains with 0 … `max_z` contacts, (max_z + 1,).

        NaN where there are fewer than `min_grains` of them.
        """
        groups = [self.pressure[self.contacts == z] for z in range(max_z + 1)]
        return np.array([group.mean() if len(group) >= min_grains else np.nan for group in groups])


def grain_stress(packing: Packing, interaction: Interaction) -> GrainStress:
    """Contact numbers and pressures of all grains and contacts: C, Figs. 9 and 10."""
    contacts = packing.contacts
    force = forces_on_i(contacts, interaction)[:, :2]
    binary = np.einsum("ca,ca->c", force, contacts.normal) * contacts.distance
    numbers, sums = (
        np.bincount(contacts.i, weights, packing.n) + np.bincount(contacts.j, weights, packing.n)
        for weights in (np.ones(len(binary)), binary)
    )
    return GrainStress(numbers.astype(int), sums / (4.0 * packing.box_length**2), binary)
