"""Names of what is seen under several tangential laws, once for each of them."""

from __future__ import annotations

from grainmodes.dataset.units import NUMBER, RATE
from grainmodes.dataset.variable import BLOCK, Variable
from grainmodes.parameters.law import TANGENTIAL_LAWS

STATE = ("seed", "comparison_state")

SEEN = {
    "pairs_slipping": (NUMBER, "complex pairs of J / M, springs at their threshold slipping"),
    "pairs_sticking": (NUMBER, "complex pairs of J / M, springs at their threshold sticking"),
    "slipping": (NUMBER, "contacts at their threshold"),
    "rate": (RATE, "largest omega_i of these pairs, springs slipping; 0: none"),
    "growth": (RATE, "rate at which the released state leaves; NaN: no pair"),
}
"""What is seen in a state → its unit and meaning."""

NAMES = {
    "comparison_count": Variable(
        BLOCK, "i8", NUMBER, "number of states under several tangential laws"
    ),
    "comparison_strain": Variable(
        STATE, "f8", NUMBER, "strain of a state that all laws are looked at"
    ),
    **{
        f"comparison_{number}_{law}": Variable(STATE, "f8", unit, f"{meaning}; law {law}")
        for law in TANGENTIAL_LAWS
        for number, (unit, meaning) in SEEN.items()
    },
}
