"""J on both sides of Coulomb's threshold, and what grows fastest: C (11)–(13), Sec. VIII.

    M q̈ = −J q,   M⁻¹J u = λ u,   iω = −i λ^(1/2) = ω_i − iω_r grows where Im λ > 0       (12)

A sharp spring at its threshold slips if pushed on and sticks if pulled back, so that J, which does
not exist there, has a limit from either side. They are those of the same contacts with

    slipping   s → (1 + ε) s        sticking   s → (1 − ε) s        h alike

whose forces are the same to ε. Every other spring, and every smooth law, has one J.

| C        | name              | shape, type              |
| -------- | ----------------- | ------------------------ |
| λ        | eigenvalue        | complex, 0 without pairs |
| u        | mode              | (N, 3) complex, of q     |
| ω_r, ω_i | frequency, rate   | float, 1/t_0             |
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy.linalg

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.jacobian import assemble, stiffness_of
from grainmodes.packing.mass_weighted import mass_weighted_jacobian, root_mass
from grainmodes.packing.state import Packing
from grainmodes.response.stability import REAL

SLIPPING, STICKING = 1.0, -1.0

EDGE = 1e-9
"""ε: well above the rounding of a spring that has slipped, well below any other distance."""


class Oscillation(NamedTuple):
    """The complex pairs of a J, and of them the one that grows fastest."""

    pairs: int
    eigenvalue: complex
    stiffest: float

    @property
    def rate(self) -> float:
        """ω_i; 0 where there is no pair."""
        return float(np.sqrt(complex(self.eigenvalue)).imag)

    @property
    def frequency(self) -> float:
        """ω_r."""
        return float(np.sqrt(complex(self.eigenvalue)).real)


def beside_threshold(contacts: Contacts, side: float) -> Contacts:
    """The contacts with springs a little longer (`SLIPPING`) or shorter (`STICKING`)."""
    return replace(contacts, spring_state=(1.0 + side * EDGE) * contacts.displacement)


def slipping_contacts(contacts: Contacts, interaction: Interaction) -> np.ndarray:
    """Contacts at Coulomb's threshold or beyond, where ∂f_T/∂s = 0 on the slipping side; (C,)."""
    return stiffness_of(beside_threshold(contacts, SLIPPING), interaction)[:, 2, 2] == 0.0


def oscillation(
    packing: Packing, contacts: Contacts, interaction: Interaction, side: float
) -> Oscillation:
    """The complex pairs of M⁻¹J on one side, by LAPACK.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    values = scipy.linalg.eigvals(_scaled(packing, contacts, interaction, side), overwrite_a=True)
    fastest = _fastest(values)
    stiffest = float(np.sqrt(np.abs(values).max()))
    pairs = int(np.count_nonzero(values.imag > REAL))
    return Oscillation(pairs, complex(values[fastest]) if pairs else 0.0, stiffest)


def growing_mode(
    packing: Packing, contacts: Contacts, interaction: Interaction, side: float
) -> np.ndarray:
    """u of the pair that grows fastest, max|u| = 1; (N, 3) complex.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    values, vectors = scipy.linalg.eig(_scaled(packing, contacts, interaction, side))
    u = vectors[:, _fastest(values)].reshape(-1, 3) / root_mass(packing.mass)
    return u / np.abs(u).max()


def _fastest(values: np.ndarray) -> int:
    """Place of the eigenvalue of a pair with the largest ω_i."""
    return int(np.argmax(np.where(values.imag > REAL, np.sqrt(values.astype(complex)).imag, -1.0)))


def _scaled(packing: Packing, contacts: Contacts, interaction: Interaction, side: float):
    """M^(−1/2) J M^(−1/2) on one side, dense (3N, 3N)."""
    stiffness = stiffness_of(beside_threshold(contacts, side), interaction)
    matrix = assemble(stiffness, contacts.i, contacts.j, packing.n)
    return mass_weighted_jacobian(matrix, packing.mass).toarray()
