"""Columns that several figures share: column → (unit, meaning)."""

POINT = {
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("k_N", "tangential stiffness k_T"),
}
"""Columns that say at which point of the grid a row lies."""

LAW = {"law": ("-", "normal contact law")}
SEED = {"seed": ("1", "seed of the sample")}

RIGIDITY_UNIT = "k_N d^(1/2); harmonic: k_N"
"""Unit of moduli and stresses under either normal contact law."""
