"""Names of the stage `release`: one run per damping rate, the first of them without damping.

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
from grainmodes.dataset.variable import BLOCK, Variable

RUN = ("seed", "damping")
RECORD = ("seed", "damping", "record")
FRAME = ("seed", "frame")
SPECTRUM = ("seed", "spectrum")
GRAIN = ("seed", "grain")


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
        BLOCK, "i1", NUMBER, "1 if there was an unstable state to release, else 0"
    ),
    "release_rate_linear": Variable(
        BLOCK, "f8", RATE, "growth rate omega_i of the pair without damping, from its eigenvalue"
    ),
    "release_frequency_linear": Variable(
        BLOCK, "f8", RATE, "frequency omega_r of the pair without damping, from its eigenvalue"
    ),
    "release_damping": Variable(RUN, "f8", RATE, "damping rate eta_0 of a run"),
    "release_rate_damped": Variable(
        RUN, "f8", RATE, "growth rate of the pair under eta_0, from its eigenvalue"
    ),
    # the fits and the end of each run
    **_fit("release_displacement", "M", AREA),
    **_fit("release_rotation", "A", SQUARED_ANGLE),
    **_onset("release_end", "M leaves its fit"),
    **_onset("release_change", "the contacts first change"),
    **_onset("release_second", "M first exceeds the square of the mean overlap"),
    "release_largest_square": Variable(RUN, "f8", AREA, "largest M of a run"),
    **_after("pressure", MODULUS, "pressure"),
    **_after("stress_xy", MODULUS, "stress sigma_xy"),
    **_after("stress_yx", MODULUS, "stress sigma_yx"),
    **_after("contact_number", NUMBER, "mean number of contacts of a grain"),
    **_after("sliding", NUMBER, "number of sliding contacts"),
    **_after("kinetic_energy", ENERGY, "kinetic energy"),
    "release_start_pressure": Variable(BLOCK, "f8", MODULUS, "pressure at the start"),
    "release_start_stress_xy": Variable(BLOCK, "f8", MODULUS, "stress sigma_xy at the start"),
    "release_start_contact_number": Variable(
        BLOCK, "f8", NUMBER, "mean number of contacts of a grain at the start"
    ),
    "release_spiral_misfit": Variable(
        BLOCK,
        "f8",
        NUMBER,
        "root mean square of the motion in the film that spirals do not describe",
    ),
    "release_spiral_overlap": Variable(
        BLOCK, "f8", NUMBER, "overlap of the spirals with the eigenvector of the pair"
    ),
    "release_spiral_opening": Variable(
        BLOCK,
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
    **_sides("release_contacts", GRAIN, "i8", NUMBER, "number of contacts of a grain"),
    **_sides("release_grain_pressure", GRAIN, "f8", MODULUS, "pressure P_i of a grain"),
    **_sides(
        "release_binary_pressure",
        ("seed", "binary"),
        "f8",
        ENERGY,
        "r . f of a contact (its distance times its normal force)",
    ),
}
