"""Rigidity from one sparse solution: A, Sec. III B, with the signs and terms of the forces.

    g = dσ_xy/dγ,   σ_αβ = −(1/L²) Σ f^α r^β                              A (14)–(16)
    J u = Σ a        force balance after an affine step A = (r_y, 0)       A (31), (34)
    g_αβ = −(1/L²) Σ [ (a + K δu)_α r_β + f_α A_β ]                        A (39)–(41)

with δu the relative displacement of the contact, (u_i − u_j, ℓ_i + ℓ_j). The affine force rate is

    loaded     a = K (A, 0)           the affine motion loads the springs, as in continuous shear
    unloaded   a = K (A, −t·A)        it does not (A's step strain): ds = t·A + dℓ = 0

so that the two differ only in the rotation that accompanies the affine step. The f_α A_β term makes
g_yx differ from g_xy by σ_yy; B (43) drops it. Printed A (36)–(37), (40), (44)–(46) do not follow
from the forces: J̃ breaks translation invariance and the sign of g_A comes out negative.

| symbol     | name       |   | symbol    | name           |
| ---------- | ---------- | - | --------- | -------------- |
| A          | affine     |   | u         | nonaffine      |
| a          | rate       |   | g_A, g_NA | affine, nonaffine of `Moduli` |
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.pinned_factor import PinnedFactor
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import SIGNS, forces_on_i, is_frictionless, sum_over_contacts
from grainmodes.packing.jacobian import assemble, stiffness_of
from grainmodes.packing.state import Packing, backbone


@dataclass(frozen=True)
class Moduli:
    """Both parts of dσ_αβ/dγ, (2, 2) in k_N d^(1/2), and the non-affine field u, (N, k) in d."""

    affine: np.ndarray
    nonaffine: np.ndarray
    displacement: np.ndarray

    @property
    def g_affine(self) -> float:
        """g_A of σ_xy."""
        return float(self.affine[0, 1])

    @property
    def g_nonaffine(self) -> float:
        """g_NA of σ_xy."""
        return float(self.nonaffine[0, 1])

    @property
    def g(self) -> float:
        """g = g_A + g_NA of σ_xy."""
        return self.g_affine + self.g_nonaffine


@dataclass(frozen=True)
class Rigidity:
    """Moduli of both steps; the same object twice where friction does not exist."""

    unloaded: Moduli
    loaded: Moduli


def rigidity(packing: Packing, interaction: Interaction, threshold: int = 2) -> Rigidity:
    """g of a packing in force balance, without its rattlers: A (31), (39)–(41).

    The field u is that of the packing without rattlers.

    Args:
        threshold: a grain with at most so many contacts is a rattler.

    Raises:
        FloppyError: the backbone has zero modes beyond the translations.
        PackingError: two grains lie at the same place.
    """
    rigid = backbone(packing, threshold)
    contacts = rigid.contacts
    loaded = AffineStep(rigid, interaction, loaded=True)
    matrix = assemble(loaded.stiffness, contacts.i, contacts.j, rigid.n)
    factor = PinnedFactor(matrix, symmetric=contacts.spring_state is None)
    response = loaded.moduli(factor.solve(loaded.force))
    if is_frictionless(interaction):
        return Rigidity(response, response)
    unloaded = AffineStep(rigid, interaction, loaded=False)
    return Rigidity(unloaded.moduli(factor.solve(unloaded.force)), response)


class AffineStep:
    """An affine step of a packing without rattlers: the forces it causes, and its moduli.

    Attributes:
        stiffness: K of every contact, (C, k, k) in k_N d^(1/2).
        force: Σ a on every grain, (N, k) in k_N d^(3/2) per unit strain.

    Args:
        loaded: whether the affine step loads the tangential springs.
    """

    def __init__(self, packing: Packing, interaction: Interaction, loaded: bool):
        contacts = packing.contacts
        self._packing, self._interaction = packing, interaction
        self.stiffness = stiffness_of(contacts, interaction)
        self._affine = affine_displacement(contacts, self.stiffness.shape[1], loaded)
        self._rate = np.einsum("cab,cb->ca", self.stiffness, self._affine)
        self.force = sum_over_contacts(contacts, self._rate, packing.n)

    def moduli(self, nonaffine: np.ndarray) -> Moduli:
        """Both parts of dσ/dγ for the u with J u = `force`, (N, k) or (kN,) in d: A (39)–(41)."""
        contacts, area = self._packing.contacts, self._packing.box_length**2
        u = nonaffine.reshape(self._packing.n, -1).copy()
        u[:, :2] -= u[:, :2].mean(axis=0)
        branch = contacts.normal * contacts.distance[:, None]
        response = np.einsum("cab,cb->ca", self.stiffness, relative_displacement(contacts, u))
        prestress = forces_on_i(contacts, self._interaction)[:, :2].T @ self._affine[:, :2]
        return Moduli(
            -(self._rate[:, :2].T @ branch + prestress) / area,
            -(response[:, :2].T @ branch) / area,
            u,
        )


def affine_displacement(contacts: Contacts, k: int, loaded: bool) -> np.ndarray:
    """(r_y, 0, dℓ) of every contact per unit affine strain, (C, k) in d; without friction k = 2."""
    affine = np.zeros((len(contacts.i), k))
    affine[:, 0] = contacts.normal[:, 1] * contacts.distance
    if k == 3 and not loaded:
        affine[:, 2] = -contacts.tangent[:, 0] * affine[:, 0]
    return affine


def relative_displacement(contacts: Contacts, u: np.ndarray) -> np.ndarray:
    """δu = (u_i − u_j, ℓ_i + ℓ_j) of every contact, (C, k), for a field u (N, k)."""
    return u[contacts.i] + SIGNS[: u.shape[1]] * u[contacts.j]
