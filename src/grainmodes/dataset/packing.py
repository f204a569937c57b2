"""Names of packings: the point, the state, and how a sample came out."""

from __future__ import annotations

from grainmodes.dataset.units import (
    BOX_FRACTION,
    FORCE,
    LENGTH,
    MASS,
    MODULUS,
    NUMBER,
    SPRING_STATE,
)
from grainmodes.dataset.variable import BLOCK, Variable

NAMES = {
    # coordinates
    "seed": Variable(("seed",), "i8", NUMBER, "seed of the random placement"),
    "n": Variable(("n",), "i8", NUMBER, "number of grains"),
    "phi": Variable(("phi",), "f8", NUMBER, "projected area fraction"),
    "kt": Variable(("kt",), "f8", NUMBER, "tangential stiffness over normal stiffness, k_T / k_N"),
    "mode": Variable(
        ("mode",), "i8", NUMBER, "rank of a mode, in ascending order of the eigenvalues"
    ),
    # packing
    "position": Variable(
        ("seed", "grain", "axis"), "f8", LENGTH, "grain position in [0, L), (x, y)"
    ),
    "fraction": Variable(
        ("seed", "grain", "axis"),
        "i8",
        BOX_FRACTION,
        "grain position as an integer fraction of the box: the exact state",
    ),
    "diameter": Variable(("seed", "grain"), "f8", LENGTH, "grain diameter"),
    "mass": Variable(("seed", "grain"), "f8", MASS, "grain mass"),
    "box_length": Variable(BLOCK, "f8", LENGTH, "side L of the periodic square box"),
    "strain": Variable(BLOCK, "f8", NUMBER, "shear strain of the Lees-Edwards box"),
    "contact_i": Variable(
        ("seed", "contact"), "i4", NUMBER, "grain i of a contact, i > j; -1: no contact"
    ),
    "contact_j": Variable(
        ("seed", "contact"), "i4", NUMBER, "grain j of a contact; -1: no contact"
    ),
    "spring_state": Variable(
        ("seed", "contact"),
        "f8",
        SPRING_STATE,
        "what the tangential spring of a contact remembers: its displacement s, or its force",
    ),
    "pressure": Variable(BLOCK, "f8", MODULUS, "pressure, -(sigma_xx + sigma_yy) / 2"),
    "contact_number": Variable(
        BLOCK, "f8", NUMBER, "mean number of contacts of the grains that are not rattlers"
    ),
    "rattler_count": Variable(BLOCK, "i8", NUMBER, "number of rattlers"),
    "compressed_with_friction": Variable(
        BLOCK, "i1", NUMBER, "1 if the packing was compressed with friction, else 0"
    ),
    "phi_jamming": Variable(
        BLOCK, "f8", NUMBER, "highest phi of the trajectory at which the packing was not yet jammed"
    ),
    # how a sample came out
    "converged": Variable(BLOCK, "i1", NUMBER, "1 if the requested accuracy was reached, else 0"),
    "jammed": Variable(BLOCK, "i1", NUMBER, "1 if a rigid backbone carries a load, else 0"),
    "max_force": Variable(BLOCK, "f8", FORCE, "largest force component left on a grain"),
    "max_torque": Variable(BLOCK, "f8", FORCE, "largest scaled torque 2 T / d left on a grain"),
    "iterations": Variable(BLOCK, "i8", NUMBER, "iterations of the relaxation"),
    "step": Variable(
        BLOCK,
        "i8",
        NUMBER,
        "index of the area fraction that the trajectory has reached on its grid",
    ),
}
