"""Names of measurements that only single claims need."""

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
    "g_forward_damped": Variable(
        BLOCK, "f8", MODULUS, "rigidity from one forward step strain, relaxed by damped dynamics"
    ),
    "field_difference": Variable(
        BLOCK,
        "f8",
        NUMBER,
        "norm of the difference of the non-affine fields of theory and simulation over that of "
        "theory",
    ),
    "hessian_shift_sheared": Variable(
        BLOCK,
        "f8",
        NUMBER,
        "mean |omega / omega_H - 1| of the frequencies of J and of the effective Hessian after "
        "shear",
    ),
    "g_translational": Variable(
        BLOCK, "f8", MODULUS, "g as a sum over the modes with psi^R < 1/2 alone"
    ),
    "hessian_difference": Variable(
        BLOCK,
        "f8",
        NUMBER,
        "max |H - J| / max |J| for the effective Hessian H with tangent stiffnesses",
    ),
    "hessian_printed_difference": Variable(
        BLOCK,
        "f8",
        NUMBER,
        "max |H - J| / max |J| for the effective Hessian H with the constants k_N and k_T",
    ),
    "verlet_order_position": Variable(
        BLOCK, "f8", NUMBER, "order in the time step up to which velocity Verlet is exact in q"
    ),
    "verlet_order_velocity": Variable(
        BLOCK, "f8", NUMBER, "order in the time step up to which velocity Verlet is exact in dq/dt"
    ),
    "complex_pairs_at_rest": Variable(
        BLOCK, "f8", NUMBER, "number of complex pairs of eigenvalues of J / M before any strain"
    ),
    "asymmetry_at_rest": Variable(BLOCK, "f8", NUMBER, "max |J - J^T| / max |J| before any strain"),
}
