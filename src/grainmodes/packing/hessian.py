"""The effective Hessian of a force balance, sparse: A, Appendix H.

    H_ij = ∂²U_eff / ∂q_i ∂q_j                                                        A (H1)
    U_eff = ½ Σ [ K_N (δr⃗·n)² − (f_N/r) (δr⃗·t)² + K_T δt² ],   δt = δr⃗·t + δℓ_i + δℓ_j   A (H2)

| stiffness | K_N      | K_T         |                                      |
| --------- | -------- | ----------- | ------------------------------------ |
| tangent   | f_N'(ξ)  | −∂f_T/∂s    | the slopes of the contact law        |
| printed   | k_N      | k_T         | (H2) to the letter                   |

With the slopes, H equals J where every s = 0. Where s ≠ 0, J also contains terms with ∂f_T/∂ξ and
the rotation of the tangent, −(f_T/r) n tᵀ; H leaves both out and stays symmetric. The printed
constants are the slopes of harmonic grains; those of Hertzian grains are smaller by the factors
3/2 ξ^(1/2) and ξ^(1/2).

A prints δt = δr⃗·t − (δℓ_i + δℓ_j), for rotations in the other sense, ℓ → −ℓ, which changes no
eigenvalue. Here ℓ is that of `jacobian`, so that H and J can be compared entry by entry.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from grainmodes.kernels.contacts import normal_forces, normal_slope
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import Contacts
from grainmodes.packing.forces import is_frictionless
from grainmodes.packing.jacobian import assemble, stiffness_of
from grainmodes.packing.state import Packing

STIFFNESSES = ("tangent", "printed")
"""The two choices of K_N and K_T in U_eff."""


def effective_hessian(
    packing: Packing, interaction: Interaction, stiffness: str = "tangent"
) -> sparse.csc_array:
    """H of a packing: A (H1), (kN, kN) with k = 3, or 2 without friction, in k_N d^(1/2).

    Args:
        stiffness: "tangent", K_N and K_T are slopes; "printed", the numbers k_N and k_T.

    Raises:
        ValueError: an unknown `stiffness`.
        PackingError: two grains lie at the same place.
    """
    if stiffness not in STIFFNESSES:
        raise ValueError(f"stiffness: expected one of {', '.join(STIFFNESSES)}, got {stiffness!r}")
    contacts = packing.contacts
    curvature = -_normal_part(contacts, interaction, stiffness)
    if not is_frictionless(interaction):
        curvature = _with_tangential(curvature, contacts, interaction, stiffness)
    return assemble(curvature, contacts.i, contacts.j, packing.n)


def _normal_part(contacts: Contacts, interaction: Interaction, stiffness: str) -> np.ndarray:
    """K_N n nᵀ − (f_N/r) t tᵀ of every contact, (C, 2, 2)."""
    n, t = contacts.normal, contacts.tangent
    k_n = normal_slope(interaction.normal, contacts.overlap)
    if stiffness == "printed":
        k_n = np.full(len(k_n), interaction.normal.stiffness)
    f_n = np.einsum("ca,ca->c", normal_forces(interaction, n, contacts.overlap), n)
    return _squares(k_n, n) - _squares(f_n / contacts.distance, t)


def _with_tangential(
    curvature: np.ndarray, contacts: Contacts, interaction: Interaction, stiffness: str
) -> np.ndarray:
    """The curvature (C, 2, 2) of a contact, with −K_T of the direction (t, 1) added: (C, 3, 3)."""
    k_t = -stiffness_of(contacts, interaction)[:, 2, 2]
    if stiffness == "printed":
        k_t = np.full(len(k_t), interaction.tangential.stiffness)
    sliding = np.column_stack([contacts.tangent, np.ones(len(k_t))])
    whole = -_squares(k_t, sliding)
    whole[:, :2, :2] += curvature
    return whole


def _squares(factor: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """factor · e eᵀ of every contact, from factors (C,) and directions e (C, k): (C, k, k)."""
    return factor[:, None, None] * direction[:, :, None] * direction[:, None, :]
