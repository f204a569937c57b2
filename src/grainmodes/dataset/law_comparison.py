"""Names of the comparison of tangential laws, once for each law."""

from __future__ import annotations

from grainmodes.dataset.units import NUMBER, RATE
from grainmodes.dataset.variable import BLOCK, Variable
from grainmodes.parameters.law import TANGENTIAL_LAWS

STATE = ("seed", "comparison_state")

QUANTITIES = {
    "pairs_slipping": (NUMBER, "number of complex pairs of J / M if springs at the threshold slip"),
    "pairs_sticking": (
        NUMBER,
        "number of complex pairs of J / M if springs at the threshold stick",
    ),
    "slipping": (NUMBER, "number of contacts at the Coulomb threshold"),
    "rate": (RATE, "largest omega_i of the pairs if springs at the threshold slip; 0: no pair"),
    "growth": (RATE, "simulated growth rate of the released state; NaN: no pair"),
}
"""Quantity of a state under one law → its unit and meaning."""

NAMES = {
    "comparison_count": Variable(BLOCK, "i8", NUMBER, "number of states that are compared"),
    "comparison_strain": Variable(STATE, "f8", NUMBER, "strain of a state that is compared"),
    **{
        f"comparison_{number}_{law}": Variable(STATE, "f8", unit, f"{meaning}; law {law}")
        for law in TANGENTIAL_LAWS
        for number, (unit, meaning) in QUANTITIES.items()
    },
}
