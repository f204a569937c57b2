"""Names of quasistatic shear: the curve, its events with both states, and smaller changes."""

from __future__ import annotations

from grainmodes.dataset.units import (
    ANGLE,
    BOX_FRACTION,
    ENERGY,
    LENGTH,
    MODULUS,
    NUMBER,
    SPRING_STATE,
)
from grainmodes.dataset.variable import BLOCK, Variable

STATE = ("seed", "state")
EVENT = ("seed", "event")
CHANGE = ("seed", "change")
GRAINS = ("seed", "event", "grain")
CONTACTS = ("seed", "event", "contact")


def _sides(name: str, row: Variable) -> dict[str, Variable]:
    """A row for the state before an event, and one for the state after it.

    The two states have different numbers of contacts, hence two dimensions of contacts.
    """
    rows = {}
    for side in ("before", "after"):
        own = tuple(f"contact_{side}" if d == "contact" else d for d in row.dimensions)
        meaning = f"{row.long_name}, {side} an event"
        rows[f"{name}_{side}"] = row._replace(dimensions=own, long_name=meaning)
    return rows


NAMES = {
    # the curve
    "curve_strain": Variable(STATE, "f8", NUMBER, "strain of a state of the curve; NaN: no state"),
    "curve_stress_xy": Variable(STATE, "f8", MODULUS, "stress sigma_xy of a state of the curve"),
    "curve_stress_yx": Variable(STATE, "f8", MODULUS, "stress sigma_yx of a state of the curve"),
    "curve_pressure": Variable(
        STATE, "f8", MODULUS, "pressure -(sigma_xx + sigma_yy) / 2 of a state of the curve"
    ),
    "curve_g_xy": Variable(
        STATE, "f8", MODULUS, "rigidity d sigma_xy / d strain of a state of the curve"
    ),
    "curve_g_yx": Variable(
        STATE, "f8", MODULUS, "rigidity d sigma_yx / d strain of a state of the curve"
    ),
    "curve_energy": Variable(
        STATE, "f8", ENERGY, "energy stored in the contacts of a state of the curve"
    ),
    "curve_contact_number": Variable(
        STATE, "f8", NUMBER, "mean number of contacts of the grains that carry a load"
    ),
    "curve_lowest_eigenvalue": Variable(
        STATE, "f8", MODULUS, "smallest eigenvalue of the Jacobian apart from those of translations"
    ),
    "curve_count": Variable(BLOCK, "i8", NUMBER, "number of states of the curve"),
    "coarse_strain": Variable(
        ("seed", "coarse_state"),
        "f8",
        NUMBER,
        "strain of a state of the run whose events are not bracketed",
    ),
    "coarse_stress": Variable(
        ("seed", "coarse_state"),
        "f8",
        MODULUS,
        "(sigma_xy + sigma_yx) / 2 of a state of the run whose events are not bracketed",
    ),
    # events
    "event_count": Variable(BLOCK, "i8", NUMBER, "number of plastic events"),
    "event_kind": Variable(
        EVENT,
        "i1",
        NUMBER,
        "kind of an event; 1: the stress fell, 2: the rigidity fell by 1e-2, 3: both, 0: no event",
    ),
    "event_opened": Variable(EVENT, "i8", NUMBER, "number of contacts that opened in an event"),
    "event_closed": Variable(EVENT, "i8", NUMBER, "number of contacts that closed in an event"),
    "event_reopened": Variable(
        EVENT, "i8", NUMBER, "number of contacts that opened and closed again in an event"
    ),
    **_sides("event_strain", Variable(EVENT, "f8", NUMBER, "strain")),
    **_sides("event_stress", Variable(EVENT, "f8", MODULUS, "(sigma_xy + sigma_yx) / 2")),
    **_sides("event_g", Variable(EVENT, "f8", MODULUS, "(g_xy + g_yx) / 2")),
    **_sides("event_energy", Variable(EVENT, "f8", ENERGY, "energy stored in the contacts")),
    **_sides(
        "event_lowest_eigenvalue",
        Variable(EVENT, "f8", MODULUS, "smallest eigenvalue of J apart from translations"),
    ),
    **_sides("event_asymmetry", Variable(EVENT, "f8", NUMBER, "max |J - J^T| / max |J|")),
    "event_complex_pairs_after": Variable(
        EVENT,
        "f8",
        NUMBER,
        "number of complex pairs of eigenvalues of J / M after an event; NaN: not counted",
    ),
    **_sides("event_rotation", Variable(GRAINS, "f8", LENGTH, "rotation l of every grain")),
    **_sides("event_fraction", Variable((*GRAINS, "axis"), "i8", BOX_FRACTION, "grain position")),
    **_sides(
        "event_contact_i", Variable(CONTACTS, "i4", NUMBER, "grain i of a contact (-1: no contact)")
    ),
    **_sides(
        "event_contact_j", Variable(CONTACTS, "i4", NUMBER, "grain j of a contact (-1: no contact)")
    ),
    **_sides(
        "event_spring_state",
        Variable(CONTACTS, "f8", SPRING_STATE, "spring state of a contact"),
    ),
    "event_displacement": Variable(
        (*GRAINS, "component"),
        "f8",
        LENGTH,
        "displacement of every grain in an event, (x, y, l); the mean over grains is 0",
    ),
    "event_quadrupole": Variable(
        EVENT,
        "f8",
        NUMBER,
        "multipole p_2 of the rotations around the grain that moves farthest; NaN: no event",
    ),
    "event_other_multipoles": Variable(
        EVENT, "f8", NUMBER, "mean of the multipoles p_1, p_3 and p_4 around the same grain"
    ),
    "event_quadrupole_rank": Variable(
        EVENT,
        "f8",
        NUMBER,
        "share of permutations of the rotations among the grains that have a p_2 as large",
    ),
    # the last state
    "last_asymmetry": Variable(BLOCK, "f8", NUMBER, "max |J - J^T| / max |J| of the last state"),
    "last_complex_pairs": Variable(
        BLOCK, "f8", NUMBER, "number of complex pairs of the last state; NaN: not counted"
    ),
    # what a closed loop of strain leaves behind, and linear response just after the first event
    "last_path_error": Variable(
        BLOCK, "f8", NUMBER, "largest Err of a contact in the last state before the first event"
    ),
    "last_path_increment": Variable(
        BLOCK, "f8", NUMBER, "largest Err of the last step alone, relative to its own normal"
    ),
    "last_path_turn": Variable(
        BLOCK, "f8", ANGLE, "median angle by which the contacts have turned up to there"
    ),
    "loop_strain": Variable(
        BLOCK, "f8", NUMBER, "largest strain of a closed loop in which no contact changes"
    ),
    "loop_slide": Variable(
        BLOCK, "f8", SPRING_STATE, "largest change of a spring state from 0 to that strain"
    ),
    "loop_left": Variable(
        BLOCK, "f8", SPRING_STATE, "largest change of a spring state after the whole loop"
    ),
    "rate_difference": Variable(
        BLOCK,
        "f8",
        NUMBER,
        "|simulated - theoretical| / |theoretical| of the non-affine displacement per unit strain "
        "just after the first event",
    ),
    # smaller changes
    "change_count": Variable(
        BLOCK, "i8", NUMBER, "number of steps in which contacts changed or the packing jumped"
    ),
    "change_strain_before": Variable(
        CHANGE, "f8", NUMBER, "strain before such a step; NaN: no step"
    ),
    "change_strain_after": Variable(CHANGE, "f8", NUMBER, "strain after such a step"),
    "change_opened": Variable(
        CHANGE, "i8", NUMBER, "number of contacts that opened in such a step"
    ),
    "change_closed": Variable(
        CHANGE, "i8", NUMBER, "number of contacts that closed in such a step"
    ),
    "change_jumped": Variable(
        CHANGE,
        "i1",
        NUMBER,
        "1 if the damped dynamics had to find the equilibrium after the step, else 0",
    ),
}
