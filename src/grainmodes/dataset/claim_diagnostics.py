"""Names of what single claims need."""

from __future__ import annotations

from grainmodes.dataset.units import MODULUS, NUMBER
from grainmodes.dataset.variable import BLOCK, Variable

NAMES = {
    "diagnostic_strain": Variable(
        ("seed", "diagnostic"), "f8", NUMBER, "step strains of g_forward_by_strain"
    ),
    "g_forward_by_strain": Variable(
        ("seed", "diagnostic"), "f8", MODULUS, "rigidity from one forward step strain of each size"
    ),
    "g_translational": Variable(
        BLOCK, "f8", MODULUS, "g as a sum over the modes with psi^R < 1/2 alone"
    ),
    "hessian_difference": Variable(
        BLOCK,
        "f8",
        NUMBER,
        "max |H - J| / max |J| of the effective Hessian H, tangent stiffnesses",
    ),
    "hessian_printed_difference": Variable(
        BLOCK, "f8", NUMBER, "the same with the constants k_N and k_T"
    ),
    "verlet_order_position": Variable(
        BLOCK, "f8", NUMBER, "order up to which a step of velocity Verlet is right in q"
    ),
    "verlet_order_velocity": Variable(
        BLOCK, "f8", NUMBER, "order up to which a step of velocity Verlet is right in dq/dt"
    ),
    "complex_pairs_frictional": Variable(
        BLOCK, "f8", NUMBER, "complex pairs of eigenvalues of J / M after compression with friction"
    ),
    "jammed_frictional": Variable(
        BLOCK, "f8", NUMBER, "1 if the state compressed with friction is jammed, else 0"
    ),
}
