"""Columns that several figures share: column → (unit, meaning)."""

from grainmodes.dataset.units import ENERGY, MODULUS, Laws, Unit
from grainmodes.parameters.law import ContactLaw


def unit_by_law(unit: Unit) -> str:
    """A unit under both normal laws."""
    return f"{unit.text(Laws('hertz'))}; harmonic: {unit.text(Laws('harmonic'))}"


POINT = {
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("1", "tangential stiffness over normal stiffness, k_T / k_N"),
}
"""Columns that say at which point of the grid a row lies."""

LAW = {
    "law": ("-", "normal contact law"),
    "friction_coefficient": ("1", "Coulomb's mu; empty where contacts do not slip"),
}
"""Columns that say which contacts the grains have."""

SEED = {"seed": ("1", "seed of the sample")}

RIGIDITY_UNIT = unit_by_law(MODULUS)
"""Unit of moduli and stresses under either normal contact law."""

ENERGY_UNIT = unit_by_law(ENERGY)
"""Unit of energies under either normal contact law."""


def law_values(law: ContactLaw) -> dict[str, object]:
    """The values of the columns `LAW`."""
    return {"law": law.normal, "friction_coefficient": law.friction_coefficient}
