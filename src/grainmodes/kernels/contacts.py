"""Forces and stiffnesses of a list of contacts, one formula per function.

Rows and columns are (x, y, ℓ) with relative coordinates d r⃗ = d r⃗_i − d r⃗_j and dℓ = dℓ_i + dℓ_j:

    f = f_N n + f_T t,    scaled torque on both grains = f_T
    K = | −f_N' n nᵀ + (f_N/r) t tᵀ + ∂f_T/∂s t tᵀ − ∂f_T/∂ξ t nᵀ − (f_T/r) n tᵀ    ∂f_T/∂s t |
        |  ∂f_T/∂s tᵀ − ∂f_T/∂ξ nᵀ                                                 ∂f_T/∂s   |

The last term of the first block, the rotation of the tangent, is missing in A (App. D, F) and
B (App. D3); A's (F6), (F12), (F24), (F30) put −∂f_T/∂ξ nᵀ into the transposed place.
"""

from __future__ import annotations

import numpy as np

from grainmodes.kernels.compiler import kernel
from grainmodes.kernels.laws import normal_response, tangential_response


@kernel
def spring_at(spring_state, c):
    """Spring state of contact c; 0 if friction was never loaded."""
    if spring_state is None:
        return 0.0
    return spring_state[c]


@kernel
def contact_forces(interaction, normal, overlap, spring_state):
    """(f_x, f_y, f_T) on grain i of every contact, (C, 3) in k_N d^(3/2).

    Args: normal (C, 2), overlap (C,) in d, spring_state (C,) or None.
    """
    forces = np.empty((overlap.shape[0], 3))
    for c in range(overlap.shape[0]):
        nx, ny = normal[c, 0], normal[c, 1]
        f_n, _ = normal_response(interaction.normal, overlap[c])
        f_t, _, _ = tangential_response(
            interaction.tangential, interaction.normal, overlap[c], spring_at(spring_state, c)
        )
        forces[c, 0] = f_n * nx + f_t * ny
        forces[c, 1] = f_n * ny - f_t * nx
        forces[c, 2] = f_t
    return forces


@kernel
def contact_stiffness(interaction, normal, distance, overlap, spring_state):
    """K of every contact, (C, 3, 3) in k_N d^(1/2).

    Args: normal (C, 2); distance, overlap (C,) in d; spring_state (C,) or None.
    """
    stiffness = np.empty((overlap.shape[0], 3, 3))
    for c in range(overlap.shape[0]):
        n = normal[c]
        t = np.array([n[1], -n[0]])
        f_n, slope = normal_response(interaction.normal, overlap[c])
        f_t, by_s, by_xi = tangential_response(
            interaction.tangential, interaction.normal, overlap[c], spring_at(spring_state, c)
        )
        for a in range(2):
            for b in range(2):
                stiffness[c, a, b] = (
                    -slope * n[a] * n[b]
                    + (f_n / distance[c] + by_s) * t[a] * t[b]
                    - by_xi * t[a] * n[b]
                    - f_t / distance[c] * n[a] * t[b]
                )
            stiffness[c, a, 2] = by_s * t[a]
            stiffness[c, 2, a] = by_s * t[a] - by_xi * n[a]
        stiffness[c, 2, 2] = by_s
    return stiffness


@kernel
def normal_forces(interaction, normal, overlap):
    """(f_x, f_y) on grain i of every frictionless contact, (C, 2) in k_N d^(3/2)."""
    forces = np.empty((overlap.shape[0], 2))
    for c in range(overlap.shape[0]):
        f_n, _ = normal_response(interaction.normal, overlap[c])
        forces[c, 0] = f_n * normal[c, 0]
        forces[c, 1] = f_n * normal[c, 1]
    return forces


@kernel
def normal_stiffness(interaction, normal, distance, overlap):
    """K of every frictionless contact, −f_N' n nᵀ + (f_N/r) t tᵀ; (C, 2, 2) in k_N d^(1/2)."""
    stiffness = np.empty((overlap.shape[0], 2, 2))
    for c in range(overlap.shape[0]):
        nx, ny = normal[c, 0], normal[c, 1]
        f_n, slope = normal_response(interaction.normal, overlap[c])
        turn = f_n / distance[c]
        stiffness[c, 0, 0] = -slope * nx * nx + turn * ny * ny
        stiffness[c, 1, 1] = -slope * ny * ny + turn * nx * nx
        stiffness[c, 0, 1] = -(slope + turn) * nx * ny
        stiffness[c, 1, 0] = stiffness[c, 0, 1]
    return stiffness


@kernel
def normal_slope(normal, overlap):
    """∂f_N/∂ξ of every contact, (C,) in k_N d^(1/2)."""
    slope = np.empty(overlap.shape[0])
    for c in range(overlap.shape[0]):
        slope[c] = normal_response(normal, overlap[c])[1]
    return slope
