"""What the releases of a sample leave behind, as values of one row by the names of the dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from grainmodes.dataset.padding import stack_padded
from grainmodes.protocols.release.damping_theory import CURVE, DampingTheory
from grainmodes.protocols.release.outcome import ReleaseOutcome, record_series, release_outcome
from grainmodes.protocols.release.record import MotionRecord, grain_stress
from grainmodes.protocols.release.release_run import ReleaseRun
from grainmodes.protocols.release.spirals import fit_spirals
from grainmodes.response.stability import REAL_TOLERANCE

COUNTS = ("sliding", "changed")
"""Quantities of a record that are whole numbers."""

FINAL_MEANS = (
    "mean_square_displacement",
    "pressure",
    "stress_xy",
    "stress_yx",
    "contact_number",
    "sliding",
    "kinetic_energy",
)
"""Quantities whose mean over the final state is kept."""


TAIL = 0.99
"""Quantile of P_ij that stands for the tail of its distribution."""

MAX_Z, MIN_GRAINS = 8, 4
"""Number of contacts up to which grains are grouped, and the least number of grains in a group."""


class ReleasedRuns(NamedTuple):
    """All runs of one state: along its mode, the first without damping, and one from noise."""

    kicked: list[ReleaseRun]
    from_noise: ReleaseRun
    theory: DampingTheory


def state_row(runs: ReleasedRuns) -> dict[str, object]:
    """Everything that is kept of the runs of one state."""
    kicked, theory, undamped = runs.kicked, runs.theory, runs.kicked[0]
    outcomes = [release_outcome(run, rate) for run, rate in zip(kicked, theory.rates, strict=True)]
    noise = release_outcome(runs.from_noise, undamped.start.growth_rate).displacement
    start, first = undamped.start, undamped.records[0]
    spirals = fit_spirals(undamped, outcomes[0].displacement)
    names = ("position", "diameter", "box_length", "strain")
    return {
        "release_found": True,
        **{f"release_start_{name}": getattr(start.packing, name) for name in names},
        "release_rate_linear": start.growth_rate,
        "release_frequency_linear": start.frequency,
        "release_damping": [run.drag for run in kicked],
        "release_rate_damped": theory.rates,
        "release_threshold": theory.threshold,
        "release_theory_damping": CURVE * start.growth_rate,
        "release_theory_rate": theory.curve,
        "release_noise_rate": noise.rate,
        "release_noise_frequency": noise.frequency,
        **_outcomes(outcomes),
        **_followed(undamped),
        "release_start_pressure": first.pressure,
        "release_start_stress_xy": first.stress_xy,
        "release_start_contact_number": first.contact_number,
        "release_start_sliding": first.sliding,
        "release_spiral_misfit": spirals.misfit,
        "release_spiral_overlap": spirals.overlap,
        "release_spiral_opening": spirals.axis_ratio,
        **_records(kicked),
        **_film(undamped),
        **_spectra(undamped),
        **_grain_stresses(undamped),
    }


def _outcomes(outcomes: Sequence[ReleaseOutcome]) -> dict[str, object]:
    """Fits, onsets and final means of all runs, one value for each run."""
    row: dict[str, object] = {
        "release_largest_square": [outcome.largest for outcome in outcomes],
        "release_growth_sliding": [outcome.growth_sliding for outcome in outcomes],
        "release_diffusion_exponent": [outcome.diffusion_exponent for outcome in outcomes],
    }
    for stage in ("displacement", "rotation", "end", "change", "second"):
        parts = [getattr(outcome, stage) for outcome in outcomes]
        for name, values in zip(parts[0]._fields, zip(*parts, strict=True), strict=True):
            row[f"release_{stage}_{name}"] = values
    for name in FINAL_MEANS:
        row[f"release_after_{name}"] = [getattr(outcome.after, name) for outcome in outcomes]
    return row


def _records(runs: Sequence[ReleaseRun]) -> dict[str, object]:
    """Every quantity of the records, (damping, record); shorter runs are filled up."""
    series = [record_series(run.records) for run in runs]
    row = {}
    for name in MotionRecord._fields:
        values = stack_padded([quantities[name] for quantities in series], np.nan, float)
        row[f"release_{name}"] = np.nan_to_num(values) if name in COUNTS else values
    return row


def _film(run: ReleaseRun) -> dict[str, object]:
    if not run.film:
        return {}
    return {
        "release_frame_time": [step * run.choices.time_step for step, _ in run.film],
        "release_film": np.stack([displacement for _, displacement in run.film]),
    }


def _spectra(run: ReleaseRun) -> dict[str, object]:
    """Of every spectrum the λ_i of its pairs, descending, and its number of negative real λ."""
    if not run.spectra:
        return {}
    spectra = [values for _, values in run.spectra]
    imaginary = [np.sort(values.imag[values.imag > REAL_TOLERANCE])[::-1] for values in spectra]
    real = [values.real[np.abs(values.imag) <= REAL_TOLERANCE] for values in spectra]
    return {
        "release_spectrum_time": [step * run.choices.time_step for step, _ in run.spectra],
        "release_spectrum_pairs": [len(parts) for parts in imaginary],
        "release_spectrum_negative": [np.count_nonzero(parts < -REAL_TOLERANCE) for parts in real],
        "release_spectrum_imaginary": stack_padded(imaginary, np.nan),
    }


def _followed(run: ReleaseRun) -> dict[str, object]:
    """λ_i of the released pair along the run, and when it died."""
    if run.pair is None:
        return {}
    steps, imaginary = (np.array(values) for values in zip(*run.pair.imaginary, strict=True))
    death = run.pair.death_step
    return {
        "release_pair_time": steps * run.choices.time_step,
        "release_pair_imaginary": imaginary,
        "release_death_time": np.nan if death is None else death * run.choices.time_step,
    }


def _grain_stresses(run: ReleaseRun) -> dict[str, object]:
    """How the contacts load the grains at the start and at the end of a run."""
    row: dict[str, object] = {}
    for side, packing in (("before", run.start.packing), ("after", run.motion.packing)):
        found = grain_stress(packing, run.interaction)
        row |= {
            f"release_contacts_{side}": found.contacts,
            f"release_grain_pressure_{side}": found.pressure,
            f"release_binary_pressure_{side}": found.binary,
            f"release_binary_tail_{side}": np.quantile(found.binary, TAIL),
            f"release_pressure_by_z_{side}": found.pressure_by_contacts(MAX_Z, MIN_GRAINS),
        }
    return row
