"""J and its complex pairs on both sides of Coulomb's threshold: C (11)–(13), Sec. VIII.

    M q̈ = −J q,   M⁻¹J u = λ u,   iω = −i λ^(1/2) = ω_i − iω_r grows where Im λ > 0       (12)

A sharp spring at its threshold slips if pushed on and sticks if pulled back. J does not exist
there, but has a limit from either side. The limits are the J of the same contacts with

    slipping   s → (1 + ε) s        sticking   s → (1 − ε) s        h alike

whose forces differ by ε only. Every other spring, and every smooth law, has one J.

| C        | name                   | shape, unit              |
| -------- | ---------------------- | ------------------------ |
| λ        | eigenvalue             | complex, 0 without pairs |
| u        | fastest_mode           | (N, 3) complex, of q     |
| ω_r, ω_i | frequency, growth_rate | float, 1/t_0             |
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy.linalg

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.failures import finite
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.jacobian import assemble, stiffness_of
from grainmodes.packing.mass_weighted import mass_weighted_jacobian, root_mass
from grainmodes.packing.state import Packing
from grainmodes.response.stability import REAL_TOLERANCE

SLIPPING, STICKING = 1.0, -1.0
"""The side of the threshold, as the sign of the change of |s|."""

RELATIVE_OFFSET = 1e-9
"""ε: well above the rounding of a spring that has slipped, well below any other distance."""


class FastestPair(NamedTuple):
    """The number of complex pairs of a J, and the pair among them that grows fastest.

    `highest_frequency` is the largest |λ|^(1/2) of all eigenvalues, in 1/t_0.
    """

    pairs: int
    eigenvalue: complex
    highest_frequency: float

    @property
    def growth_rate(self) -> float:
        """ω_i; 0 if there is no pair."""
        return float(np.sqrt(complex(self.eigenvalue)).imag)

    @property
    def frequency(self) -> float:
        """ω_r."""
        return float(np.sqrt(complex(self.eigenvalue)).real)


def beside_threshold(contacts: Contacts, side: float) -> Contacts:
    """The contacts with springs a little longer (`SLIPPING`) or shorter (`STICKING`)."""
    s = (1.0 + side * RELATIVE_OFFSET) * contacts.springs
    return replace(contacts, spring_state=s)


def slipping_contacts(contacts: Contacts, interaction: Interaction) -> np.ndarray:
    """Contacts at or beyond Coulomb's threshold, where ∂f_T/∂s = 0 if they slip; (C,) bool."""
    stiffness = stiffness_of(beside_threshold(contacts, SLIPPING), interaction)
    slips: np.ndarray = stiffness[:, 2, 2] == 0.0
    return slips


def fastest_pair(packing: Packing, interaction: Interaction, side: float) -> FastestPair:
    """The complex pairs of M⁻¹J on one side, by LAPACK.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    matrix = _dense_jacobian(packing, interaction, side)
    values = scipy.linalg.eigvals(matrix, overwrite_a=True)
    fastest = _place_of_fastest(values)
    highest_frequency = float(np.sqrt(np.abs(values).max()))
    pairs = int(np.count_nonzero(values.imag > REAL_TOLERANCE))
    return FastestPair(pairs, complex(values[fastest]) if pairs else 0.0, highest_frequency)


def fastest_mode(packing: Packing, interaction: Interaction, side: float) -> np.ndarray:
    """u of the pair that grows fastest, (N, 3) complex with max|u| = 1.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    values, vectors = scipy.linalg.eig(_dense_jacobian(packing, interaction, side))
    u: np.ndarray = vectors[:, _place_of_fastest(values)].reshape(-1, 3) / root_mass(packing.mass)
    u /= np.abs(u).max()
    return u


def _place_of_fastest(values: np.ndarray) -> int:
    """Place of the eigenvalue of a pair with the largest ω_i."""
    growth = np.sqrt(values.astype(complex)).imag
    return int(np.argmax(np.where(values.imag > REAL_TOLERANCE, growth, -1.0)))


def _dense_jacobian(packing: Packing, interaction: Interaction, side: float) -> np.ndarray:
    """The mass-weighted Jacobian M^(−1/2) J M^(−1/2) on one side, dense (3N, 3N)."""
    contacts = packing.contacts
    stiffness = stiffness_of(beside_threshold(contacts, side), interaction)
    matrix = assemble(stiffness, contacts.i, contacts.j, packing.n)
    dense: np.ndarray = mass_weighted_jacobian(matrix, packing.mass).toarray()
    return finite(dense)
