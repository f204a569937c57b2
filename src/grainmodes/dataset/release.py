"""Names of the stage `release`: some states of every sample, and of every state one run per
damping rate, the first of them without damping.

NaN: something did not happen in a run, or nothing was fitted.
"""

from __future__ import annotations

from grainmodes.dataset.units import (
    ANGLE,
    AREA,
    ENERGY,
    LENGTH,
    MODULUS,
    NUMBER,
    RATE,
    SQUARED_ANGLE,
    SQUARED_RATE,
    TIME,
    Unit,
)
from grainmodes.dataset.variable import Variable

STATE = ("seed", "release_state")
RUN = (*STATE, "damping")
RECORD = (*RUN, "record")
FRAME = (*STATE, "frame")
SPECTRUM = (*STATE, "spectrum")
GRAIN = (*STATE, "grain")
FOLLOWED = (*STATE, "spectrum_of_pair")
PATH = (*STATE, "path_state")
THEORY = (*STATE, "theory_damping")
Z = (*STATE, "contacts_of_grain")


def _fit(name: str, symbol: str, unit: Unit) -> dict[str, Variable]:
    """The fit size e^(2 rate t) [1 + depth cos(2 frequency t - phase)] of M or A."""
    return {
        f"{name}_rate": Variable(RUN, "f8", RATE, f"fitted growth rate omega_i of {symbol}"),
        f"{name}_rate_error": Variable(
            RUN, "f8", RATE, f"standard error of the fitted growth rate of {symbol}"
        ),
        f"{name}_frequency": Variable(RUN, "f8", RATE, f"fitted frequency omega_r of {symbol}"),
        f"{name}_frequency_error": Variable(
            RUN, "f8", RATE, f"standard error of the fitted frequency of {symbol}"
        ),
        f"{name}_size": Variable(RUN, "f8", unit, f"fitted mean of {symbol}, at time 0"),
        f"{name}_depth": Variable(
            RUN, "f8", NUMBER, f"fitted depth of the oscillation of {symbol}, 0 to 1"
        ),
        f"{name}_phase": Variable(RUN, "f8", ANGLE, f"fitted phase of the oscillation of {symbol}"),
        f"{name}_misfit": Variable(
            RUN,
            "f8",
            NUMBER,
            f"root mean square of {symbol} minus its fit, over the mean of the fit",
        ),
    }


def _onset(name: str, meaning: str) -> dict[str, Variable]:
    """The time at which something happens first, and M at that time."""
    return {
        f"{name}_time": Variable(RUN, "f8", TIME, f"time at which {meaning}"),
        f"{name}_square": Variable(RUN, "f8", AREA, f"M at the time at which {meaning}"),
    }


def _after(name: str, unit: Unit, meaning: str) -> dict[str, Variable]:
    """A mean over the end of a run."""
    return {
        f"release_after_{name}": Variable(
            RUN, "f8", unit, f"{meaning}, mean over the last tenth of a run"
        )
    }


def _sides(
    name: str, dimensions: tuple[str, ...], dtype: str, unit: Unit, meaning: str
) -> dict[str, Variable]:
    """Rows for the start and the end of the run without damping."""
    rows = {}
    for side, words in (("before", "at the start"), ("after", "at the end")):
        own = tuple(f"binary_{side}" if d == "binary" else d for d in dimensions)
        rows[f"{name}_{side}"] = Variable(own, dtype, unit, f"{meaning} {words}")
    return rows


NAMES = {
    # the pair and the runs
    "release_found": Variable(
        STATE, "i1", NUMBER, "1 if there was an unstable state to release, else 0"
    ),
    "release_rate_linear": Variable(
        STATE, "f8", RATE, "growth rate omega_i of the pair without damping, from its eigenvalue"
    ),
    "release_frequency_linear": Variable(
        STATE, "f8", RATE, "frequency omega_r of the pair without damping, from its eigenvalue"
    ),
    "release_damping": Variable(RUN, "f8", RATE, "damping rate eta_0 of a run"),
    "release_rate_damped": Variable(
        RUN, "f8", RATE, "growth rate of the pair under eta_0, from the quadratic eigenproblem"
    ),
    "release_threshold": Variable(
        STATE, "f8", RATE, "eta_0 at which the growth ends, from the quadratic eigenproblem"
    ),
    "release_theory_damping": Variable(THEORY, "f8", RATE, "eta_0 of a point of its curve"),
    "release_theory_rate": Variable(THEORY, "f8", RATE, "growth rate at a point of its curve"),
    "release_noise_rate": Variable(
        STATE, "f8", RATE, "growth rate fitted to M of the run that random velocities start"
    ),
    "release_noise_frequency": Variable(
        STATE, "f8", RATE, "frequency fitted to M of the run that random velocities start"
    ),
    # the fits and the end of each run
    **_fit("release_displacement", "M", AREA),
    **_fit("release_rotation", "A", SQUARED_ANGLE),
    **_onset("release_end", "M leaves its fit"),
    **_onset("release_change", "the contacts first change"),
    **_onset("release_second", "M first exceeds the square of the mean overlap"),
    "release_largest_square": Variable(RUN, "f8", AREA, "largest M of a run"),
    "release_growth_sliding": Variable(
        RUN, "f8", NUMBER, "largest number of sliding contacts until 2/omega_i after the growth"
    ),
    "release_diffusion_exponent": Variable(
        RUN, "f8", NUMBER, "exponent of M in time after the second instability; 1: diffusion"
    ),
    **_after("mean_square_displacement", AREA, "M"),
    **_after("pressure", MODULUS, "pressure"),
    **_after("stress_xy", MODULUS, "stress sigma_xy"),
    **_after("stress_yx", MODULUS, "stress sigma_yx"),
    **_after("contact_number", NUMBER, "mean number of contacts of a grain"),
    **_after("sliding", NUMBER, "number of sliding contacts"),
    **_after("kinetic_energy", ENERGY, "kinetic energy"),
    "release_start_position": Variable(
        (*GRAIN, "axis"), "f8", LENGTH, "grain position at the start, in [0, L), (x, y)"
    ),
    "release_start_diameter": Variable(GRAIN, "f8", LENGTH, "diameter of a grain"),
    "release_start_box_length": Variable(STATE, "f8", LENGTH, "side L of the box"),
    "release_start_strain": Variable(STATE, "f8", NUMBER, "strain at the start"),
    "release_start_pairs": Variable(
        STATE, "i8", NUMBER, "number of complex pairs of J / M at the start"
    ),
    "release_start_sliding": Variable(
        STATE, "i8", NUMBER, "number of sliding contacts at the start"
    ),
    "release_start_pressure": Variable(STATE, "f8", MODULUS, "pressure at the start"),
    "release_start_stress_xy": Variable(STATE, "f8", MODULUS, "stress sigma_xy at the start"),
    "release_start_contact_number": Variable(
        STATE, "f8", NUMBER, "mean number of contacts of a grain at the start"
    ),
    "release_spiral_misfit": Variable(
        STATE,
        "f8",
        NUMBER,
        "root mean square of the motion in the film that spirals do not describe",
    ),
    "release_spiral_overlap": Variable(
        STATE, "f8", NUMBER, "overlap of the spirals with the eigenvector of the pair"
    ),
    "release_spiral_opening": Variable(
        STATE,
        "f8",
        NUMBER,
        "median ratio of the axes of the ellipse that a grain describes; 0: a line",
    ),
    # record by record
    "release_time": Variable(RECORD, "f8", TIME, "time of a record; NaN: no record"),
    "release_mean_square_displacement": Variable(
        RECORD, "f8", AREA, "mean square displacement M since the start"
    ),
    "release_mean_square_rotation": Variable(
        RECORD, "f8", SQUARED_ANGLE, "mean square rotation angle A since the start"
    ),
    "release_pressure": Variable(RECORD, "f8", MODULUS, "pressure -(sigma_xx + sigma_yy) / 2"),
    "release_stress_xy": Variable(RECORD, "f8", MODULUS, "stress sigma_xy"),
    "release_stress_yx": Variable(RECORD, "f8", MODULUS, "stress sigma_yx"),
    "release_contact_number": Variable(RECORD, "f8", NUMBER, "mean number of contacts of a grain"),
    "release_sliding": Variable(
        RECORD, "i8", NUMBER, "number of contacts at the Coulomb threshold"
    ),
    "release_changed": Variable(
        RECORD,
        "i8",
        NUMBER,
        "number of contacts gained and lost since the start, without those of rattlers",
    ),
    "release_kinetic_energy": Variable(RECORD, "f8", ENERGY, "kinetic energy"),
    # the run without damping
    "release_frame_time": Variable(FRAME, "f8", TIME, "time of a frame of the film"),
    "release_film": Variable(
        (*FRAME, "grain", "component"),
        "f8",
        LENGTH,
        "displacement of every grain since the start, (x, y, l)",
    ),
    "release_spectrum_time": Variable(SPECTRUM, "f8", TIME, "time of a spectrum of J / M"),
    "release_spectrum_pairs": Variable(
        SPECTRUM, "i8", NUMBER, "number of complex pairs of a spectrum"
    ),
    "release_spectrum_negative": Variable(
        SPECTRUM, "i8", NUMBER, "number of negative real eigenvalues of a spectrum"
    ),
    "release_spectrum_imaginary": Variable(
        (*SPECTRUM, "pair"),
        "f8",
        SQUARED_RATE,
        "imaginary parts of the complex pairs of a spectrum, the largest first",
    ),
    "release_pair_time": Variable(
        FOLLOWED, "f8", TIME, "time at which the released pair was sought again"
    ),
    "release_pair_imaginary": Variable(
        FOLLOWED, "f8", SQUARED_RATE, "imaginary part of the released pair; 0: it is dead"
    ),
    "release_death_time": Variable(
        STATE, "f8", TIME, "time at which the released pair has died; NaN: it survives"
    ),
    # the pair along the shear
    "release_path_strain": Variable(
        PATH, "f8", NUMBER, "strain of a state of the shear with the released pair; NaN: no state"
    ),
    "release_path_real_1": Variable(
        PATH, "f8", SQUARED_RATE, "real part of lambda_1 of the released pair there"
    ),
    "release_path_real_2": Variable(
        PATH, "f8", SQUARED_RATE, "real part of lambda_2 of the released pair there"
    ),
    "release_path_imaginary": Variable(
        PATH, "f8", SQUARED_RATE, "imaginary part of lambda_1 of the released pair there"
    ),
    # grains and contacts
    **_sides("release_binary_tail", STATE, "f8", ENERGY, "99 % quantile of r . f of the contacts"),
    **_sides(
        "release_pressure_by_z",
        Z,
        "f8",
        MODULUS,
        "mean P_i of the grains with 0, 1, 2, ... contacts; NaN: fewer than 4 grains",
    ),
    **_sides("release_contacts", GRAIN, "i8", NUMBER, "number of contacts of a grain"),
    **_sides("release_grain_pressure", GRAIN, "f8", MODULUS, "pressure P_i of a grain"),
    **_sides(
        "release_binary_pressure",
        (*STATE, "binary"),
        "f8",
        ENERGY,
        "r . f of a contact (its distance times its normal force)",
    ),
}
