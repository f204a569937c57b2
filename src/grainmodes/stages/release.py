"""The stage `release`: the dynamics from the unstable state of every sample, with every damping.

A sample without a state to release is a row that says so.
"""

from __future__ import annotations

from dataclasses import asdict
from functools import partial

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.release_run import ReleaseRun
from grainmodes.protocols.release.unstable_state import UnstableState
from grainmodes.response.stability import REAL_TOLERANCE
from grainmodes.stages.long_runs import CheckpointStore, run_to_end
from grainmodes.stages.packing_rows import history_in_row
from grainmodes.stages.release_rows import runs_row
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import seed_of

MAX_RESIDUAL = 1e-6
"""Largest residual of the mode, relative to |λ|, of a state that is released."""


def release_block(
    pairs: Block,
    law: ContactLaw,
    choices: Release,
    checkpoints: CheckpointStore[ReleaseRun] | None = None,
) -> Block:
    """Release every sample of a block of the stage `complex_pairs` from its unstable state.

    Args:
        checkpoints: where runs are saved now and then; each takes minutes.
    """
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        if not pairs.variables["unstable_found"][number]:
            return {"release_found": 0, "converged": True}
        start, seed = unstable_state(pairs, number), seed_of(pairs, number)
        check_pair(start, interaction)
        drags = [damping * start.growth_rate for damping in (0.0, *choices.dampings)]
        begin = partial(ReleaseRun.from_state, start, interaction, choices)
        runs = [
            run_to_end(partial(begin, drag), checkpoints, f"seed-{seed}-{place}")
            for place, drag in enumerate(drags)
        ]
        return runs_row(runs)

    config = {"law": asdict(law), "release": asdict(choices)}
    return response_block(pairs, "release", config, law, sample)


def unstable_state(block: Block, number: int) -> UnstableState:
    """The unstable state in a row.

    Raises:
        PackingError: a stored value is NaN or infinite.
    """
    row = {name: array[number] for name, array in block.variables.items()}
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


def check_pair(start: UnstableState, interaction: Interaction) -> None:
    """Check that the pair is one of the state.

    Raises:
        ArithmeticError: the imaginary part of the eigenvalue is 0 to rounding, or the mode is not
            an eigenvector of M⁻¹J.
    """
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
