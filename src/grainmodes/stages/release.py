"""The stage `release`: the unstable state of every sample let go, without damping and with.

A run takes minutes, so a keeper may be told now and then how far it has come and asked where to go
on; a run depends on its state alone, and where it was interrupted leaves no trace in the numbers.
A sample without a state to release is a row that says so.
"""

from __future__ import annotations

from dataclasses import asdict
from typing import Protocol

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.contacts import History
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.outcome import Fate, columns, fate_of
from grainmodes.protocols.release.record import Record, burden
from grainmodes.protocols.release.run import Run
from grainmodes.protocols.release.spirals import spirals_of
from grainmodes.protocols.shear.unstable import Unstable
from grainmodes.response.stability import REAL
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import seed_of

EXACT = 1e-6
"""Largest residual of the mode, relative to |λ|, of a state that is released."""

AFTER = ("pressure", "stress_xy", "stress_yx", "contact_number", "sliding", "kinetic_energy")
"""Quantities whose mean over the end of a run is kept."""


class Keeper(Protocol):
    """Where runs are kept between two jobs."""

    def kept(self, name: str) -> Run | None:
        """The run of this name as far as it came, if one was kept."""

    def watch(self, name: str, run: Run) -> None:
        """Called after every look: keep the run if it is time to."""


def release_block(
    pairs: Block, law: ContactLaw, choices: Release, keeper: Keeper | None = None
) -> Block:
    """Every sample of a block of the stage `pairs` released from its unstable state."""
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        if not pairs.variables["unstable_found"][number]:
            return {"release_found": 0, "converged": True}
        start, seed = unstable_of(pairs, number), seed_of(pairs, number)
        check(start, interaction)
        runs = [
            followed(
                Run.begin(start, interaction, choices, eta * start.rate), keeper, f"seed-{seed}-{k}"
            )
            for k, eta in enumerate((0.0, *choices.dampings))
        ]
        return row_of(runs)

    config = {"law": asdict(law), "release": asdict(choices)}
    return response_block(pairs, "release", config, law, sample)


def unstable_of(block: Block, number: int) -> Unstable:
    """The unstable state in a row."""
    row = {name: array[number] for name, array in block.variables.items()}
    held = row["unstable_contact_i"] >= 0
    names = ("unstable_contact_i", "unstable_contact_j", "unstable_spring_state")
    packing = Packing(
        np.ascontiguousarray(row["unstable_fraction"].T),
        row["diameter"],
        row["mass"],
        float(row["box_length"]),
        float(row["unstable_strain"]),
        row["unstable_rotation"],
        History.of(*(row[name][held] for name in names)),
    )
    value = complex(row["unstable_eigenvalue_real"], row["unstable_eigenvalue_imag"])
    mode = row["unstable_mode_real"] + 1j * row["unstable_mode_imag"]
    return Unstable(packing.checked(), value, mode)


def check(start: Unstable, interaction: Interaction) -> None:
    """Refuse a pair that is none of the state's.

    Raises:
        ArithmeticError: its imaginary part is 0 to rounding, or its mode no eigenvector of M⁻¹J.
    """
    if start.eigenvalue.imag <= REAL:
        raise ArithmeticError(
            f"the pair: expected Im above {REAL:.1e}, got {start.eigenvalue.imag:.1e}"
        )
    residual = start.residual(interaction)
    if not residual < EXACT:
        raise ArithmeticError(f"the mode: expected a residual below {EXACT}, got {residual:.1e}")


def followed(run: Run, keeper: Keeper | None, name: str) -> Run:
    """A run to its end, taken up where its keeper has it."""
    run = (keeper and keeper.kept(name)) or run
    while not run.done:
        run.advance()
        if keeper:
            keeper.watch(name, run)
    return run


def row_of(runs: list[Run]) -> dict[str, object]:
    """All that is kept of the runs of one sample, the first of them without damping."""
    fates, free = [fate_of(run) for run in runs], runs[0]
    start, packing = free.start, free.start.packing
    names = ("position", "diameter", "mass", "box_length", "strain")
    return {
        **{name: getattr(packing, name) for name in names},
        "release_found": 1,
        "release_rate_linear": start.rate,
        "release_frequency_linear": start.frequency,
        "release_damping": [run.drag for run in runs],
        "release_rate_damped": [start.rate_under(run.drag) for run in runs],
        **_fates(fates),
        **{
            f"release_start_{name}": getattr(free.records[0], name)
            for name in ("pressure", "stress_xy", "contact_number")
        },
        **{
            f"release_spiral_{name}": value
            for name, value in spirals_of(free, fates[0].displacement)._asdict().items()
        },
        **_records(runs),
        **_film(free),
        **_spectra(free),
        **_sides(free),
        "converged": True,
    }


def _fates(fates: list[Fate]) -> dict[str, object]:
    row: dict[str, object] = {"release_largest_square": [fate.largest for fate in fates]}
    for part in ("displacement", "rotation", "end", "change", "second"):
        of = [getattr(fate, part) for fate in fates]
        row |= {f"release_{part}_{name}": [getattr(x, name) for x in of] for name in of[0]._fields}
    return row | {
        f"release_after_{name}": [getattr(fate.after, name) for fate in fates] for name in AFTER
    }


def _records(runs: list[Run]) -> dict[str, object]:
    """Every quantity (damping, record), shorter runs filled up."""
    longest = max(len(run.records) for run in runs)
    of_runs = [columns(run.records) for run in runs]
    row = {}
    for name in Record._fields:
        whole = np.full((len(runs), longest), np.nan)
        for place, of in enumerate(of_runs):
            whole[place, : len(of[name])] = of[name]
        row[f"release_{name}"] = np.nan_to_num(whole) if name in ("sliding", "changed") else whole
    return row


def _film(run: Run) -> dict[str, object]:
    if not run.film:
        return {}
    return {
        "release_frame_time": [step * run.choices.time_step for step, _ in run.film],
        "release_film": np.stack([field for _, field in run.film]),
    }


def _spectra(run: Run) -> dict[str, object]:
    if not run.spectra:
        return {}
    imaginary = [np.sort(found.imag[found.imag > REAL])[::-1] for _, found in run.spectra]
    whole = np.full((len(imaginary), max(map(len, imaginary))), np.nan)
    for place, parts in enumerate(imaginary):
        whole[place, : len(parts)] = parts
    real = [found.real[np.abs(found.imag) <= REAL] for _, found in run.spectra]
    return {
        "release_spectrum_time": [step * run.choices.time_step for step, _ in run.spectra],
        "release_spectrum_pairs": [len(parts) for parts in imaginary],
        "release_spectrum_negative": [np.count_nonzero(parts < -REAL) for parts in real],
        "release_spectrum_imaginary": whole,
    }


def _sides(run: Run) -> dict[str, object]:
    """What the grains bear at the start and at the end of a run."""
    row = {}
    for side, packing in (("before", run.start.packing), ("after", run.motion.packing)):
        found = burden(packing, run.interaction)
        row |= {
            f"release_contacts_{side}": found.contacts,
            f"release_grain_pressure_{side}": found.pressure,
            f"release_binary_pressure_{side}": found.binary,
        }
    return row
