"""Names of the state of a sheared sample whose complex pair grows fastest."""

from __future__ import annotations

from grainmodes.dataset.variable import BLOCK, MODULUS, Variable

GRAINS = ("seed", "grain")
CONTACTS = ("seed", "unstable_contact")

NAMES = {
    "unstable_found": Variable(
        BLOCK, "i1", "1", "1 if a state with a complex pair was met, else 0"
    ),
    "unstable_strain": Variable(BLOCK, "f8", "1", "strain of the state that is left fastest"),
    "unstable_fraction": Variable((*GRAINS, "axis"), "i8", "2^-64 L", "its grain positions"),
    "unstable_rotation": Variable(GRAINS, "f8", "d", "its rotations l of the grains"),
    "unstable_contact_i": Variable(CONTACTS, "i4", "1", "grain i of its contacts; -1: none"),
    "unstable_contact_j": Variable(CONTACTS, "i4", "1", "grain j of its contacts; -1: none"),
    "unstable_slip": Variable(CONTACTS, "f8", "d", "tangential displacement of its contacts"),
    "unstable_eigenvalue_real": Variable(
        BLOCK, "f8", MODULUS, "real part of its eigenvalue of J / M"
    ),
    "unstable_eigenvalue_imag": Variable(
        BLOCK, "f8", MODULUS, "imaginary part of its eigenvalue of J / M, above 0"
    ),
    "unstable_mode_real": Variable(
        (*GRAINS, "component"), "f8", "1", "real part of its eigenvector in (x, y, l)"
    ),
    "unstable_mode_imag": Variable(
        (*GRAINS, "component"), "f8", "1", "imaginary part of its eigenvector in (x, y, l)"
    ),
}
