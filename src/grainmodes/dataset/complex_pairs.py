"""Names of complex pairs along a quasistatic shear: states, tracks of pairs, exceptional points.

The rows of all exceptional points follow one another; `neighbour_point` and `followed_point` state
to which point a row belongs.
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
TRACK = ("seed", "track")
POINT = ("seed", "exceptional_point")
NEAR = ("seed", "neighbour_state")
PATH = ("seed", "followed_state")
PRODUCT = ("seed", "product")
RELEASE = ("seed", "release_state")
RELEASE_CONTACT = (*RELEASE, "contact")
RELEASE_GRAINS = (*RELEASE, "grain", "component")
RELEASE_PATH = (*RELEASE, "path_state")
KIND = (
    "0: nothing, 1: coalescence, 2: contact change, 3: jump, 4: invariant plane lost, "
    "5: undecided, 6: the search for it failed"
)

NAMES = {
    # the states of the run
    "pair_state_count": Variable(
        BLOCK, "i8", NUMBER, "number of states in which complex pairs were computed"
    ),
    "pair_strain": Variable(STATE, "f8", NUMBER, "strain of a state; NaN: no state"),
    "pair_count": Variable(STATE, "f8", NUMBER, "number of complex pairs of eigenvalues of J / M"),
    "pair_count_jacobian": Variable(
        STATE, "f8", NUMBER, "number of complex pairs of eigenvalues of J; NaN: not counted"
    ),
    "pair_growth": Variable(
        STATE, "f8", RATE, "largest growth rate omega_i of the pairs of a state; NaN: no pair"
    ),
    "pair_frequency": Variable(STATE, "f8", RATE, "frequency omega_r of the fastest growing pair"),
    "pair_condition": Variable(
        STATE,
        "f8",
        NUMBER,
        "condition number of the eigenvalue of the fastest growing pair; NaN: no pair",
    ),
    "pair_dense": Variable(
        STATE, "i1", NUMBER, "1 if a dense solver computed the pairs of this state, else 0"
    ),
    # the pairs
    "track_count": Variable(
        BLOCK, "i8", NUMBER, "number of complex pairs that were born along the shear"
    ),
    "track_birth_before": Variable(
        TRACK, "f8", NUMBER, "strain before the birth of a pair; NaN: no pair"
    ),
    "track_birth_after": Variable(TRACK, "f8", NUMBER, "strain after the birth of a pair"),
    "track_birth_kind": Variable(TRACK, "i1", NUMBER, f"how a pair was born; {KIND}"),
    "track_death_before": Variable(
        TRACK, "f8", NUMBER, "strain before the death of a pair; NaN: it lives until the end"
    ),
    "track_death_after": Variable(
        TRACK, "f8", NUMBER, "strain after the death of a pair; NaN: it lives until the end"
    ),
    "track_death_kind": Variable(TRACK, "i1", NUMBER, f"how a pair died; {KIND}"),
    "track_growth": Variable(
        TRACK, "f8", RATE, "largest growth rate omega_i of a pair along its track"
    ),
    # exceptional points
    "exceptional_point_count": Variable(
        BLOCK, "i8", NUMBER, "number of births and deaths whose exceptional point was located"
    ),
    "exceptional_point_track": Variable(
        POINT, "i4", NUMBER, "index of the pair that is born or dies; -1: no point"
    ),
    "exceptional_point_birth": Variable(
        POINT, "i1", NUMBER, "1: birth of the pair, 0: death of the pair"
    ),
    "exceptional_point_kind": Variable(POINT, "i1", NUMBER, f"what happens at the point; {KIND}"),
    "exceptional_point_before": Variable(
        POINT, "f8", NUMBER, "strain at the lower end of the bracket; NaN: no point"
    ),
    "exceptional_point_after": Variable(
        POINT, "f8", NUMBER, "strain at the upper end of the bracket"
    ),
    "exceptional_point_strain": Variable(
        POINT,
        "f8",
        NUMBER,
        "gamma_c, where (lambda_1 - lambda_2)^2 vanishes; otherwise the middle of the bracket",
    ),
    "exceptional_point_exponent_real": Variable(
        POINT,
        "f8",
        NUMBER,
        "exponent of |lambda_1 - lambda_2| on the side where both are real; NaN: not fitted",
    ),
    "exceptional_point_exponent_real_error": Variable(
        POINT, "f8", NUMBER, "standard error of exceptional_point_exponent_real"
    ),
    "exceptional_point_exponent_pair": Variable(
        POINT,
        "f8",
        NUMBER,
        "exponent of |lambda_1 - lambda_2| on the side where they are a complex pair",
    ),
    "exceptional_point_exponent_pair_error": Variable(
        POINT, "f8", NUMBER, "standard error of exceptional_point_exponent_pair"
    ),
    # states around them
    "neighbour_point": Variable(
        NEAR,
        "i4",
        NUMBER,
        "index of the exceptional point that a neighbouring state belongs to; -1: no state",
    ),
    "neighbour_distance": Variable(
        NEAR, "f8", NUMBER, "strain of a neighbouring state minus gamma_c; NaN: no state"
    ),
    "neighbour_sum": Variable(
        NEAR, "f8", SQUARED_RATE, "lambda_1 + lambda_2 of a neighbouring state"
    ),
    "neighbour_discriminant": Variable(
        NEAR,
        "f8",
        FOURTH_POWER_OF_RATE,
        "(lambda_1 - lambda_2)^2 of a neighbouring state, negative for a complex pair",
    ),
    "neighbour_product": Variable(
        NEAR, "f8", NUMBER, "scalar product of the two eigenvectors of a neighbouring state"
    ),
    "neighbour_condition": Variable(
        NEAR, "f8", NUMBER, "condition number of the two eigenvalues of a neighbouring state"
    ),
    "neighbour_residual": Variable(
        NEAR,
        "f8",
        NUMBER,
        "residual of the plane of the two eigenvectors, relative to the largest entry of J / M",
    ),
    # the two modes along the run
    "followed_point": Variable(
        PATH,
        "i4",
        NUMBER,
        "index of the exceptional point that a followed state belongs to; -1: no state",
    ),
    "followed_strain": Variable(
        PATH,
        "f8",
        NUMBER,
        "strain of a state along which the two modes are followed; NaN: no state",
    ),
    "followed_real_1": Variable(
        PATH, "f8", SQUARED_RATE, "real part of lambda_1 of a followed state"
    ),
    "followed_real_2": Variable(
        PATH, "f8", SQUARED_RATE, "real part of lambda_2 of a followed state"
    ),
    "followed_imaginary": Variable(
        PATH, "f8", SQUARED_RATE, "imaginary part of lambda_1 of a followed state"
    ),
    "followed_product": Variable(
        PATH, "f8", NUMBER, "scalar product of the two eigenvectors of a followed state"
    ),
    "product_strain": Variable(
        PRODUCT,
        "f8",
        NUMBER,
        "strain of a state whose modes are all compared, at most 20 grains; NaN: no state",
    ),
    "product_mode": Variable(
        PRODUCT, "i4", NUMBER, "index of the mode that becomes one of the pair"
    ),
    "product_other": Variable(
        PRODUCT, "i4", NUMBER, "index of another mode, from 0 in ascending order of the real part"
    ),
    "product_value": Variable(
        PRODUCT,
        "f8",
        NUMBER,
        "scalar product of the eigenvectors of product_mode and product_other",
    ),
    # the states to release, one for each growth rate that a scene lists
    "unstable_found": Variable(
        RELEASE,
        "i1",
        NUMBER,
        "1 if a state to release was found, whose pair grows linearly far enough, else 0",
    ),
    "unstable_strain": Variable(RELEASE, "f8", NUMBER, "strain of a state to release"),
    "unstable_pair_count": Variable(
        RELEASE, "i8", NUMBER, "number of complex pairs of the state to release"
    ),
    "unstable_fraction": Variable(
        (*RELEASE, "grain", "axis"), "i8", BOX_FRACTION, "grain position in the state to release"
    ),
    "unstable_rotation": Variable(
        (*RELEASE, "grain"), "f8", LENGTH, "rotation l of every grain in the state to release"
    ),
    "unstable_contact_i": Variable(
        RELEASE_CONTACT,
        "i4",
        NUMBER,
        "grain i of a contact in the state to release; -1: no contact",
    ),
    "unstable_contact_j": Variable(
        RELEASE_CONTACT,
        "i4",
        NUMBER,
        "grain j of a contact in the state to release; -1: no contact",
    ),
    "unstable_spring_state": Variable(
        RELEASE_CONTACT, "f8", SPRING_STATE, "spring state of a contact in the state to release"
    ),
    "unstable_eigenvalue_real": Variable(
        RELEASE, "f8", SQUARED_RATE, "real part of the eigenvalue of J / M of the pair to release"
    ),
    "unstable_eigenvalue_imag": Variable(
        RELEASE,
        "f8",
        SQUARED_RATE,
        "imaginary part of the eigenvalue of J / M of the pair to release",
    ),
    "unstable_condition": Variable(
        RELEASE, "f8", NUMBER, "condition number of the eigenvalue of the pair to release"
    ),
    "unstable_residual": Variable(
        RELEASE,
        "f8",
        NUMBER,
        "residual of the plane of the pair to release, relative to the largest entry of J / M",
    ),
    "unstable_linear_range": Variable(
        RELEASE, "f8", AREA, "M at which the linear growth of the pair first changes the contacts"
    ),
    "unstable_mode_real": Variable(
        RELEASE_GRAINS,
        "f8",
        NUMBER,
        "real part of the eigenvector q of J / M of the pair to release, (x, y, l), norm 1",
    ),
    "unstable_mode_imag": Variable(
        RELEASE_GRAINS,
        "f8",
        NUMBER,
        "imaginary part of the eigenvector q of J / M of the pair to release",
    ),
    "unstable_path_strain": Variable(
        RELEASE_PATH,
        "f8",
        NUMBER,
        "strain of a state along which the pair to release is followed; NaN: no state",
    ),
    "unstable_path_real_1": Variable(
        RELEASE_PATH, "f8", SQUARED_RATE, "real part of lambda_1 of the pair to release there"
    ),
    "unstable_path_real_2": Variable(
        RELEASE_PATH, "f8", SQUARED_RATE, "real part of lambda_2 of the pair to release there"
    ),
    "unstable_path_imaginary": Variable(
        RELEASE_PATH, "f8", SQUARED_RATE, "imaginary part of lambda_1 of the pair to release there"
    ),
}
