"""What is looked at while an unstable state moves: C (29), (30), Sec. VI B.

    M = ⟨|Δr_i|²⟩,   A = ⟨Δθ_i²⟩,   Δ against the start, θ_i = 2 ℓ_i / d_i              C (29), (30)
    P = −(σ_xx + σ_yy)/2 = Σ_i P_i,   P_i = Σ_j r_ij · f_ij / (4 L²)                    C, Fig. 10

A contact slides where |s| ≥ s* (C (8)). Stresses are those of the contacts alone; the kinetic
energy stands beside them. Differences of positions are exact in the fractions, 2⁻⁶⁴ L, but the
forces feel the rounding of distances, 1e-16 d, so that M means something above about 1e-30 d².
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts, rattlers
from grainmodes.packing.forces import forces_on_i, sliding, stress
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import Packing, find_contacts, nonaffine_motion
from grainmodes.relaxation.balance import most_loose
from grainmodes.relaxation.dynamics import Motion


class Record(NamedTuple):
    """The state at a time, in numbers.

    `changed` counts the contacts that the start lacks or has more, between grains that carry load
    there: a loose grain may begin to touch at any time and bears nothing. `sliding` counts those at
    Coulomb's threshold; the contact number is 2 C / N over all grains.
    """

    time: float
    mean_square_displacement: float
    mean_square_rotation: float
    pressure: float
    stress_xy: float
    stress_yx: float
    contact_number: float
    sliding: int
    changed: int
    kinetic_energy: float


def record(time: float, now: Motion, start: Packing, interaction: Interaction) -> Record:
    """Look at a moving packing that has left `start`, at rest and with the same grains."""
    packing, contacts = now.packing, find_contacts(now.packing)
    moved = nonaffine_motion(start, packing)
    sigma = stress(packing, contacts, interaction)
    return Record(
        time,
        float((moved[:, :2] ** 2).sum(axis=1).mean()),
        float(((2.0 * moved[:, 2] / packing.diameter) ** 2).mean()),
        -float(np.trace(sigma)) / 2.0,
        float(sigma[0, 1]),
        float(sigma[1, 0]),
        2.0 * len(contacts.i) / packing.n,
        int(sliding(contacts, interaction).sum()),
        changes(contacts, find_contacts(start), packing.n, interaction),
        0.5 * float((generalized_mass(packing.mass) * now.velocity**2).sum()),
    )


def changes(now: Contacts, before: Contacts, n: int, interaction: Interaction) -> int:
    """Contacts gained and lost between the grains that carried load before."""
    held = ~rattlers(before, n, most_loose(interaction))
    return len(np.setxor1d(*(_pairs(of.among(held)) for of in (now, before)), assume_unique=True))


class Burden(NamedTuple):
    """Contacts (N,) and P_i (N,) of every grain, r_ij · f_ij (C,) of every contact."""

    contacts: np.ndarray
    pressure: np.ndarray
    binary: np.ndarray


def burden(packing: Packing, interaction: Interaction) -> Burden:
    """Contact numbers and pressures, grain by grain and contact by contact: C, Figs. 9 and 10."""
    contacts = find_contacts(packing)
    force = forces_on_i(contacts, interaction)[:, :2]
    binary = np.einsum("ca,ca->c", force, contacts.normal) * contacts.distance
    of_grain = [
        np.bincount(contacts.i, weights, packing.n) + np.bincount(contacts.j, weights, packing.n)
        for weights in (np.ones(len(binary)), binary)
    ]
    return Burden(of_grain[0].astype(int), of_grain[1] / (4.0 * packing.box_length**2), binary)


def _pairs(contacts: Contacts) -> np.ndarray:
    """One number for every pair of grains, the same in any packing."""
    return contacts.i.astype(np.int64) << 32 | contacts.j
