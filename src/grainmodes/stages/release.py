"""The stage `release`: the dynamics from the unstable states of every sample, with every damping.

A sample without a state to release is a row that says so; a state whose release fails is one that
says why, and the other states of the sample go on.
"""

from __future__ import annotations

from dataclasses import asdict
from functools import partial

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.release import GROWTH_RANGE, Release
from grainmodes.protocols.release.damping_theory import DampingTheory
from grainmodes.protocols.release.release_run import ReleaseRun
from grainmodes.protocols.release.unstable_state import UnstableState
from grainmodes.response.stability import REAL_TOLERANCE
from grainmodes.stages.long_runs import CheckpointStore, run_to_end
from grainmodes.stages.packing_rows import history_in_row
from grainmodes.stages.release_rows import ReleasedRuns, state_row
from grainmodes.stages.rows import SAMPLE_ERRORS, loss, response_block, stacked
from grainmodes.stages.samples import seed_of

MAX_RESIDUAL = 1e-6
"""Largest residual of the mode, relative to |λ|, of a state that is released."""


def release_block(
    pairs: Block,
    law: ContactLaw,
    choices: Release,
    checkpoints: CheckpointStore[ReleaseRun] | None = None,
) -> Block:
    """Release every sample of a block of the stage `complex_pairs` from its unstable states.

    Args:
        checkpoints: where runs are saved now and then; each takes minutes.
    """
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        seed, states = seed_of(pairs, number), pairs.variables["unstable_found"][number]
        rows: list[dict[str, object]] = [{"release_found": False} for _ in states]
        errors: dict[str, Exception | None] = {}
        for place in np.flatnonzero(states).tolist():
            name = f"seed-{seed}-{place}"
            try:
                start = checked_state(pairs, number, place, interaction)
                runs = _runs(start, interaction, choices, seed, checkpoints, name)
            except SAMPLE_ERRORS as error:
                errors[f"state {place}"] = error
            else:
                rows[place] = state_row(runs) | _along_the_shear(pairs, number, place)
        lost_all = bool(errors) and len(errors) == np.count_nonzero(states)
        return {**stacked(rows), "converged": not lost_all, **loss(errors)}

    config = {"law": asdict(law), "release": asdict(choices)}
    return response_block(pairs, "release", config, law, sample)


def _runs(
    start: UnstableState,
    interaction: Interaction,
    choices: Release,
    seed: int,
    checkpoints: CheckpointStore[ReleaseRun] | None,
    name: str,
) -> ReleasedRuns:
    """All runs of one state: without damping, with every damping, and from noise."""
    drags = np.array([0.0, *choices.dampings]) * start.growth_rate
    begin = partial(ReleaseRun.from_state, start, interaction, choices)
    noise = partial(
        ReleaseRun.from_noise, start, interaction, choices, seed, 10.0 * GROWTH_RANGE[1]
    )
    starts = [*(partial(begin, float(drag)) for drag in drags), noise]
    *kicked, from_noise = (
        run_to_end(begun, checkpoints, f"{name}-{place}") for place, begun in enumerate(starts)
    )
    return ReleasedRuns(kicked, from_noise, DampingTheory.from_state(start, interaction, choices))


def unstable_state(block: Block, number: int, place: int) -> UnstableState:
    """The unstable state at a place of a row.

    Raises:
        PackingError: a stored value is NaN or infinite.
    """
    row = {name: array[number] for name, array in block.variables.items()}
    row |= {name: array[place] for name, array in row.items() if name.startswith("unstable_")}
    packing = Packing(
        np.ascontiguousarray(row["unstable_fraction"].T),
        row["diameter"],
        row["mass"],
        float(row["box_length"]),
        float(row["unstable_strain"]),
        row["unstable_rotation"],
        history_in_row(row, "unstable_"),
    )
    value = complex(row["unstable_eigenvalue_real"], row["unstable_eigenvalue_imag"])
    mode = row["unstable_mode_real"] + 1j * row["unstable_mode_imag"]
    return UnstableState(packing.checked(), value, mode)


def _along_the_shear(block: Block, number: int, place: int) -> dict[str, object]:
    """The pair along the shear, and the number of pairs of the state, as the row keeps them."""
    row = {
        name.replace("unstable_", "release_"): block.variables[name][number, place]
        for name in block.variables
        if name.startswith("unstable_path_")
    }
    return row | {"release_start_pairs": block.variables["unstable_pair_count"][number, place]}


def checked_state(block: Block, number: int, place: int, interaction: Interaction) -> UnstableState:
    """The unstable state at a place of a row, its pair checked.

    Raises:
        PackingError: a stored value is NaN or infinite.
        ArithmeticError: the imaginary part of the eigenvalue is 0 to rounding, or the mode is not
            an eigenvector of M⁻¹J.
    """
    start = unstable_state(block, number, place)
    if start.eigenvalue.imag <= REAL_TOLERANCE:
        raise ArithmeticError(
            f"eigenvalue of the pair: expected Im above {REAL_TOLERANCE:.1e}, "
            f"got {start.eigenvalue.imag:.1e}"
        )
    residual = start.residual(interaction)
    if not residual < MAX_RESIDUAL:
        raise ArithmeticError(
            f"mode of the pair: expected a residual below {MAX_RESIDUAL}, got {residual:.1e}"
        )
    return start
