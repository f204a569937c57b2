"""Names of the detail of one event; the event itself has the names of `shear`.

NaN in a field: a grain that carries no load, or a rotation where there is no friction.
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
    "bracket_min_step": Variable(BRACKET, "f8", NUMBER, "smallest step Delta gamma_Th of a run"),
    "bracket_kind": Variable(
        BRACKET, "i1", NUMBER, "kind of the first event of a run, as event_kind; 0: no event"
    ),
    "bracket_strain_before": Variable(
        BRACKET, "f8", NUMBER, "strain before the first event of a run; NaN: no event"
    ),
    "bracket_strain_after": Variable(
        BRACKET, "f8", NUMBER, "strain after the first event of a run"
    ),
    "bracket_stress_before": Variable(
        BRACKET, "f8", MODULUS, "(sigma_xy + sigma_yx) / 2 before the first event of a run"
    ),
    "bracket_stress_after": Variable(
        BRACKET, "f8", MODULUS, "(sigma_xy + sigma_yx) / 2 after the first event of a run"
    ),
    "bracket_opened": Variable(
        BRACKET, "i8", NUMBER, "number of contacts that opened in the bracket"
    ),
    "bracket_closed": Variable(
        BRACKET, "i8", NUMBER, "number of contacts that closed in the bracket"
    ),
    "bracket_curve_strain": Variable(
        CURVE, "f8", NUMBER, "strain of a state of a run around its first event; NaN: no state"
    ),
    "bracket_curve_stress": Variable(
        CURVE, "f8", MODULUS, "(sigma_xy + sigma_yx) / 2 of a state of a run around its first event"
    ),
    # states around the closest bracket
    "near_distance": Variable(
        NEAR,
        "f8",
        NUMBER,
        "strain of a state minus that of the far end of the bracket; negative before the event",
    ),
    "near_strain": Variable(NEAR, "f8", NUMBER, "strain of a state near the event"),
    "near_stress": Variable(
        NEAR, "f8", MODULUS, "(sigma_xy + sigma_yx) / 2 of a state near the event"
    ),
    "near_lowest_eigenvalue": Variable(
        NEAR,
        "f8",
        MODULUS,
        "smallest eigenvalue of a state near the event, apart from those of translations",
    ),
    "near_g": Variable(
        NEAR, "f8", MODULUS, "(g_xy + g_yx) / 2 of a state near the event by linear response"
    ),
    "near_g_numerical": Variable(
        NEAR,
        "f8",
        MODULUS,
        "slope of (sigma_xy + sigma_yx) / 2 at a state near the event, on the side away from it",
    ),
    "near_changes": Variable(
        NEAR,
        "i8",
        NUMBER,
        "number of contacts that differ between a state and its end of the bracket",
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
    "rate_simulated": Variable(GRAINS, "f8", LENGTH, "the field `rate` from a relaxed step"),
    # the integral of tangential velocities
    "path_strain": Variable(
        PATH, "f8", NUMBER, "strain of a state of the run up to its first event"
    ),
    "path_error_largest": Variable(
        PATH,
        "f8",
        NUMBER,
        "largest Err of a contact: normal part of the integral of its tangential velocity v_T",
    ),
    "path_error_median": Variable(PATH, "f8", NUMBER, "median Err over the contacts"),
    "path_error_increment": Variable(
        PATH,
        "f8",
        NUMBER,
        "largest Err of the last step alone, relative to the normal of that step",
    ),
    "path_turn_median": Variable(
        PATH, "f8", ANGLE, "median angle by which the contacts have turned since they closed"
    ),
    "path_length_median": Variable(
        PATH,
        "f8",
        NUMBER,
        "median relative difference between the length of the integral of v_T and s",
    ),
    "path_count": Variable(BLOCK, "i8", NUMBER, "number of states for which v_T was integrated"),
}
