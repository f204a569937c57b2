"""Names of unstable states let go: a run for every damping, the first without any.

What did not happen in a run, and a law that was not fitted, is NaN.
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
from grainmodes.dataset.variable import BLOCK, Variable

RUN = ("seed", "damping")
RECORD = ("seed", "damping", "record")
FRAME = ("seed", "frame")
SPECTRUM = ("seed", "spectrum")
GRAIN = ("seed", "grain")


def _law(name: str, symbol: str, unit: Unit) -> dict[str, Variable]:
    """The law e^(2 rate t) [1 + depth cos(2 frequency t - phase)] of M or A."""
    return {
        f"{name}_rate": Variable(RUN, "f8", RATE, f"fitted growth rate omega_i of {symbol}"),
        f"{name}_rate_error": Variable(RUN, "f8", RATE, "its standard error"),
        f"{name}_frequency": Variable(RUN, "f8", RATE, f"fitted frequency omega_r of {symbol}"),
        f"{name}_frequency_error": Variable(RUN, "f8", RATE, "its standard error"),
        f"{name}_size": Variable(RUN, "f8", unit, f"mean of {symbol} in its law, at time 0"),
        f"{name}_depth": Variable(
            RUN, "f8", NUMBER, f"depth of the oscillation of {symbol}, 0 to 1"
        ),
        f"{name}_phase": Variable(RUN, "f8", ANGLE, "its phase"),
        f"{name}_misfit": Variable(
            RUN, "f8", NUMBER, f"root mean square of {symbol} - law, over the law's mean"
        ),
    }


def _moment(name: str, meaning: str) -> dict[str, Variable]:
    return {
        f"{name}_time": Variable(RUN, "f8", TIME, f"time at which {meaning}"),
        f"{name}_square": Variable(RUN, "f8", AREA, f"M when {meaning}"),
    }


def _after(name: str, unit: Unit, meaning: str) -> dict[str, Variable]:
    return {
        f"release_after_{name}": Variable(RUN, "f8", unit, f"{meaning}, mean of the last tenth")
    }


def _sides(name: str, dimensions: tuple[str, ...], dtype: str, unit: Unit, meaning: str):
    """Rows for the start and the end of the run without damping."""
    rows = {}
    for side, words in (("before", "at the start"), ("after", "at the end")):
        own = tuple(f"binary_{side}" if d == "binary" else d for d in dimensions)
        rows[f"{name}_{side}"] = Variable(own, dtype, unit, f"{meaning} {words}")
    return rows


NAMES = {
    # the pair and the runs
    "release_found": Variable(BLOCK, "i1", NUMBER, "1 if there was an unstable state to release"),
    "release_rate_linear": Variable(BLOCK, "f8", RATE, "omega_i of the pair, undamped"),
    "release_frequency_linear": Variable(BLOCK, "f8", RATE, "omega_r of the pair, undamped"),
    "release_damping": Variable(RUN, "f8", RATE, "eta_0 of a run"),
    "release_rate_damped": Variable(RUN, "f8", RATE, "growth rate of the pair under eta_0"),
    # what became of it
    **_law("release_displacement", "M", AREA),
    **_law("release_rotation", "A", SQUARED_ANGLE),
    **_moment("release_end", "M leaves its law"),
    **_moment("release_change", "contacts change first"),
    **_moment("release_second", "M exceeds the mean overlap squared"),
    "release_largest_square": Variable(RUN, "f8", AREA, "largest M of a run"),
    **_after("pressure", MODULUS, "pressure"),
    **_after("stress_xy", MODULUS, "stress sigma_xy"),
    **_after("stress_yx", MODULUS, "stress sigma_yx"),
    **_after("contact_number", NUMBER, "contacts of a grain"),
    **_after("sliding", NUMBER, "sliding contacts"),
    **_after("kinetic_energy", ENERGY, "kinetic energy"),
    "release_start_pressure": Variable(BLOCK, "f8", MODULUS, "pressure at the start"),
    "release_start_stress_xy": Variable(BLOCK, "f8", MODULUS, "stress sigma_xy at the start"),
    "release_start_contact_number": Variable(
        BLOCK, "f8", NUMBER, "contacts of a grain at the start"
    ),
    "release_spiral_misfit": Variable(
        BLOCK, "f8", NUMBER, "what spirals leave of the motion in the film, root mean square"
    ),
    "release_spiral_overlap": Variable(
        BLOCK, "f8", NUMBER, "overlap of the spirals with the eigenvector"
    ),
    "release_spiral_opening": Variable(
        BLOCK, "f8", NUMBER, "median ratio of the axes of a grain's turn; 0: lines"
    ),
    # record by record
    "release_time": Variable(RECORD, "f8", TIME, "time of a record; NaN: none"),
    "release_mean_square_displacement": Variable(RECORD, "f8", AREA, "M"),
    "release_mean_square_rotation": Variable(RECORD, "f8", SQUARED_ANGLE, "A"),
    "release_pressure": Variable(RECORD, "f8", MODULUS, "pressure (sigma_xx + sigma_yy) / -2"),
    "release_stress_xy": Variable(RECORD, "f8", MODULUS, "stress sigma_xy"),
    "release_stress_yx": Variable(RECORD, "f8", MODULUS, "stress sigma_yx"),
    "release_contact_number": Variable(RECORD, "f8", NUMBER, "mean number of contacts of a grain"),
    "release_sliding": Variable(RECORD, "i8", NUMBER, "contacts at Coulomb's threshold"),
    "release_changed": Variable(
        RECORD, "i8", NUMBER, "contacts gained and lost since the start, but for loose grains"
    ),
    "release_kinetic_energy": Variable(RECORD, "f8", ENERGY, "kinetic energy"),
    # the run without damping
    "release_frame_time": Variable(FRAME, "f8", TIME, "time of a frame of the film"),
    "release_film": Variable(
        (*FRAME, "grain", "component"), "f8", LENGTH, "displacement since the start, (x, y, l)"
    ),
    "release_spectrum_time": Variable(SPECTRUM, "f8", TIME, "time of a spectrum of J / M"),
    "release_spectrum_pairs": Variable(SPECTRUM, "i8", NUMBER, "its complex pairs"),
    "release_spectrum_negative": Variable(SPECTRUM, "i8", NUMBER, "its real eigenvalues below 0"),
    "release_spectrum_imaginary": Variable(
        (*SPECTRUM, "pair"), "f8", SQUARED_RATE, "imaginary parts of its pairs, the largest first"
    ),
    **_sides("release_contacts", GRAIN, "i8", NUMBER, "contacts of a grain"),
    **_sides("release_grain_pressure", GRAIN, "f8", MODULUS, "P_i of a grain"),
    **_sides("release_binary_pressure", ("seed", "binary"), "f8", ENERGY, "r . f of a contact"),
}
