"""Names of an event detail of one event, beside those of `shear` for the event itself.

Before the event a distance is negative. A grain that carries no load has no number in a field, nor
has a rotation where friction does not exist.
"""

from __future__ import annotations

from grainmodes.dataset.units import ANGLE, LENGTH, MODULUS, NUMBER
from grainmodes.dataset.variable import BLOCK, Variable

BRACKET = ("seed", "bracket")
CURVE = ("seed", "bracket", "bracket_state")
NEAR = ("seed", "near")
PATH = ("seed", "path_state")
GRAINS = ("seed", "grain", "component")

NAMES = {
    # the first event, bracketed ever closer
    "bracket_min_step": Variable(BRACKET, "f8", NUMBER, "smallest step Delta gamma_Th of a walk"),
    "bracket_kind": Variable(
        BRACKET, "i1", NUMBER, "what its first event was, as event_kind; 0: no event"
    ),
    "bracket_strain_before": Variable(BRACKET, "f8", NUMBER, "strain before the event; NaN: none"),
    "bracket_strain_after": Variable(BRACKET, "f8", NUMBER, "strain after the event"),
    "bracket_stress_before": Variable(
        BRACKET, "f8", MODULUS, "(sigma_xy + sigma_yx) / 2 before the event"
    ),
    "bracket_stress_after": Variable(
        BRACKET, "f8", MODULUS, "(sigma_xy + sigma_yx) / 2 after the event"
    ),
    "bracket_opened": Variable(BRACKET, "i8", NUMBER, "contacts that opened in the bracket"),
    "bracket_closed": Variable(BRACKET, "i8", NUMBER, "contacts that closed in the bracket"),
    "bracket_curve_strain": Variable(
        CURVE, "f8", NUMBER, "strain of a state of the walk around its event; NaN: none"
    ),
    "bracket_curve_stress": Variable(CURVE, "f8", MODULUS, "its (sigma_xy + sigma_yx) / 2"),
    # states around the closest bracket
    "near_distance": Variable(
        NEAR, "f8", NUMBER, "strain to the far end of the bracket; below 0 before the event"
    ),
    "near_strain": Variable(NEAR, "f8", NUMBER, "strain of a state near the event"),
    "near_stress": Variable(NEAR, "f8", MODULUS, "its (sigma_xy + sigma_yx) / 2"),
    "near_lowest_eigenvalue": Variable(
        NEAR, "f8", MODULUS, "its smallest eigenvalue but the translations"
    ),
    "near_g": Variable(NEAR, "f8", MODULUS, "its (g_xy + g_yx) / 2 by linear response"),
    "near_g_numerical": Variable(
        NEAR, "f8", MODULUS, "slope of its (sigma_xy + sigma_yx) / 2 away from the event"
    ),
    "near_changes": Variable(
        NEAR, "i8", NUMBER, "contacts that differ from those at this end of the bracket"
    ),
    # grains
    "lowest_mode_before": Variable(
        GRAINS, "f8", NUMBER, "eigenvector of the smallest eigenvalue before the event, norm 1"
    ),
    "lowest_mode_after": Variable(
        GRAINS, "f8", NUMBER, "eigenvector of the smallest eigenvalue after the event, norm 1"
    ),
    "rate": Variable(
        GRAINS, "f8", LENGTH, "non-affine displacement per unit strain just after the event"
    ),
    "rate_simulated": Variable(GRAINS, "f8", LENGTH, "rate from a relaxed step"),
    # the integral of tangential velocities
    "path_strain": Variable(PATH, "f8", NUMBER, "strain of a state of the walk up to its event"),
    "path_error_largest": Variable(
        PATH, "f8", NUMBER, "largest Err of a contact: normal part of its integral of v_T"
    ),
    "path_error_median": Variable(PATH, "f8", NUMBER, "median Err of the contacts"),
    "path_error_increment": Variable(
        PATH, "f8", NUMBER, "largest Err of the last step alone, against its own normal"
    ),
    "path_turn_median": Variable(
        PATH, "f8", ANGLE, "median angle by which contacts have turned since they closed"
    ),
    "path_length_median": Variable(
        PATH, "f8", NUMBER, "median relative difference of the integral's length and s"
    ),
    "path_count": Variable(BLOCK, "i8", NUMBER, "number of states with an integral of v_T"),
}
