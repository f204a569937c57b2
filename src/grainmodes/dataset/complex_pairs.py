"""Names of complex pairs along a quasistatic shear: states, lives of pairs, exceptional points.

Series of several located points stand one after the other; `..._of` tells which point a number
belongs to.
"""

from __future__ import annotations

from grainmodes.dataset.units import (
    AREA,
    BOX_FRACTION,
    FOURTH_POWER_OF_RATE,
    LENGTH,
    NUMBER,
    RATE,
    SPRING_STATE,
    SQUARED_RATE,
)
from grainmodes.dataset.variable import BLOCK, Variable

STATE = ("seed", "pair_state")
LIFE = ("seed", "track")
LOCATED = ("seed", "exceptional_point")
NEAR = ("seed", "neighbour_state")
PATH = ("seed", "followed_state")
PRODUCT = ("seed", "product")
CONTACT = ("seed", "contact")
GRAINS = ("seed", "grain", "component")
KIND = "0: none; 1: coalescence; 2: contact change; 3: jump; 4: plane lost; 5: undecided"

NAMES = {
    # the states of the walk
    "pair_state_count": Variable(
        BLOCK, "i8", NUMBER, "number of states in which pairs were looked for"
    ),
    "pair_strain": Variable(STATE, "f8", NUMBER, "strain of a state; NaN: none"),
    "pair_count": Variable(STATE, "f8", NUMBER, "complex pairs of eigenvalues of J / M"),
    "pair_count_jacobian": Variable(STATE, "f8", NUMBER, "complex pairs of J; NaN: not counted"),
    "pair_growth": Variable(STATE, "f8", RATE, "largest growth rate omega_i; NaN: no pair"),
    "pair_frequency": Variable(STATE, "f8", RATE, "omega_r of the pair that grows fastest"),
    "pair_condition": Variable(STATE, "f8", NUMBER, "condition of its eigenvalue; NaN: none"),
    "pair_dense": Variable(STATE, "i1", NUMBER, "1 if LAPACK solved this state"),
    # the pairs
    "track_count": Variable(BLOCK, "i8", NUMBER, "number of complex pairs that were born"),
    "track_birth_before": Variable(
        LIFE, "f8", NUMBER, "strain before the birth of a pair; NaN: none"
    ),
    "track_birth_after": Variable(LIFE, "f8", NUMBER, "strain after the birth of a pair"),
    "track_birth_kind": Variable(LIFE, "i1", NUMBER, f"what its birth was; {KIND}"),
    "track_death_before": Variable(LIFE, "f8", NUMBER, "strain before its death; NaN: it lives"),
    "track_death_after": Variable(LIFE, "f8", NUMBER, "strain after its death; NaN: it lives"),
    "track_death_kind": Variable(LIFE, "i1", NUMBER, f"what its death was; {KIND}"),
    "track_growth": Variable(LIFE, "f8", RATE, "largest growth rate omega_i of its states"),
    # exceptional points
    "exceptional_point_count": Variable(
        BLOCK, "i8", NUMBER, "number of births and deaths that were located"
    ),
    "exceptional_point_track": Variable(LOCATED, "i4", NUMBER, "number of the pair; -1: none"),
    "exceptional_point_birth": Variable(LOCATED, "i1", NUMBER, "1: a birth; 0: a death"),
    "exceptional_point_kind": Variable(LOCATED, "i1", NUMBER, f"what it was; {KIND}"),
    "exceptional_point_before": Variable(
        LOCATED, "f8", NUMBER, "lower end of its bracket; NaN: none"
    ),
    "exceptional_point_after": Variable(LOCATED, "f8", NUMBER, "upper end of its bracket"),
    "exceptional_point_strain": Variable(
        LOCATED, "f8", NUMBER, "gamma_c: where (lambda_1 - lambda_2)^2 is 0; else the middle"
    ),
    "exceptional_point_exponent_real": Variable(
        LOCATED,
        "f8",
        NUMBER,
        "exponent of |lambda_1 - lambda_2| where both are real; NaN: not fitted",
    ),
    "exceptional_point_exponent_real_error": Variable(LOCATED, "f8", NUMBER, "its standard error"),
    "exceptional_point_exponent_pair": Variable(
        LOCATED, "f8", NUMBER, "exponent of |lambda_1 - lambda_2| where they are a pair"
    ),
    "exceptional_point_exponent_pair_error": Variable(LOCATED, "f8", NUMBER, "its standard error"),
    # states around them
    "neighbour_point": Variable(NEAR, "i4", NUMBER, "number of the located point; -1: none"),
    "neighbour_distance": Variable(NEAR, "f8", NUMBER, "strain - gamma_c of a state; NaN: none"),
    "neighbour_sum": Variable(NEAR, "f8", SQUARED_RATE, "lambda_1 + lambda_2 there"),
    "neighbour_discriminant": Variable(
        NEAR, "f8", FOURTH_POWER_OF_RATE, "(lambda_1 - lambda_2)^2 there, below 0 for a pair"
    ),
    "neighbour_product": Variable(NEAR, "f8", NUMBER, "scalar product of the two eigenvectors"),
    "neighbour_condition": Variable(NEAR, "f8", NUMBER, "condition of the two eigenvalues"),
    "neighbour_residual": Variable(
        NEAR, "f8", NUMBER, "residual of their plane, in units of the largest entry of J / M"
    ),
    # the two modes along the walk
    "followed_point": Variable(PATH, "i4", NUMBER, "number of the located point; -1: none"),
    "followed_strain": Variable(PATH, "f8", NUMBER, "strain of a state; NaN: none"),
    "followed_real_1": Variable(PATH, "f8", SQUARED_RATE, "real part of lambda_1"),
    "followed_real_2": Variable(PATH, "f8", SQUARED_RATE, "real part of lambda_2"),
    "followed_imaginary": Variable(PATH, "f8", SQUARED_RATE, "imaginary part of lambda_1"),
    "followed_product": Variable(PATH, "f8", NUMBER, "scalar product of the two eigenvectors"),
    "product_strain": Variable(PRODUCT, "f8", NUMBER, "strain of a state of few grains; NaN: none"),
    "product_mode": Variable(PRODUCT, "i4", NUMBER, "number of the mode that is looked at"),
    "product_other": Variable(PRODUCT, "i4", NUMBER, "number of another mode, from 0 by real part"),
    "product_value": Variable(PRODUCT, "f8", NUMBER, "scalar product of the two eigenvectors"),
    # the state to release
    "unstable_found": Variable(
        BLOCK, "i1", NUMBER, "1 if a complex pair of a state had room to grow"
    ),
    "unstable_strain": Variable(
        BLOCK, "f8", NUMBER, "strain of the state with the fastest of these"
    ),
    "unstable_fraction": Variable(
        ("seed", "grain", "axis"), "i8", BOX_FRACTION, "grain position in that state"
    ),
    "unstable_rotation": Variable(("seed", "grain"), "f8", LENGTH, "rotation l in that state"),
    "unstable_contact_i": Variable(CONTACT, "i4", NUMBER, "grain i of a contact; -1: none"),
    "unstable_contact_j": Variable(CONTACT, "i4", NUMBER, "grain j of a contact; -1: none"),
    "unstable_spring_state": Variable(
        CONTACT, "f8", SPRING_STATE, "tangential displacement of a contact"
    ),
    "unstable_eigenvalue_real": Variable(BLOCK, "f8", SQUARED_RATE, "lambda_r of this pair"),
    "unstable_eigenvalue_imag": Variable(BLOCK, "f8", SQUARED_RATE, "lambda_i of this pair"),
    "unstable_condition": Variable(BLOCK, "f8", NUMBER, "condition of this eigenvalue"),
    "unstable_residual": Variable(
        BLOCK, "f8", NUMBER, "residual of the pair's plane, in units of the largest entry of J / M"
    ),
    "unstable_linear_range": Variable(
        BLOCK, "f8", AREA, "M at which its linear growth changes the contacts first"
    ),
    "unstable_mode_real": Variable(
        GRAINS, "f8", NUMBER, "real part of its eigenvector q of J / M, (x, y, l), norm 1"
    ),
    "unstable_mode_imag": Variable(GRAINS, "f8", NUMBER, "imaginary part of its eigenvector q"),
}
