"""The stage `shear`: every packing of a block sheared quasistatically, with its events."""

from __future__ import annotations

from dataclasses import asdict, replace
from functools import partial

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import bracket_first_event
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.stages.long_runs import CheckpointStore, run_to_end
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import jammed_packing, seed_of
from grainmodes.stages.shear_rows import bracket_ends, coarse_run_row, run_row


def shear_block(
    packings: Block,
    law: ContactLaw,
    choices: Shear,
    coarse_run: bool = False,
    checkpoints: CheckpointStore[QuasistaticRun] | None = None,
) -> Block:
    """The stress-strain curve and the events of every packing.

    A sample that ends before its last strain keeps what it has, and is not converged.

    Args:
        coarse_run: adds a run in steps Δγ_in whose events are not bracketed, and the first event
            in brackets of every width.
        checkpoints: where runs are saved now and then; a sample takes minutes to hours.
    """
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        if not jammed:
            return {"curve_count": 0, "jammed": False, "converged": True}
        start, name = QuasistaticRun.from_packing, f"seed-{seed_of(packings, number)}"
        run = run_to_end(partial(start, packing, interaction, choices), checkpoints, name)
        row = run_row(run) | ({} if run.done else {"failure": run.failure})
        if coarse_run:
            coarse = partial(start, packing, interaction, replace(choices, min_step=choices.step))
            row |= coarse_run_row(run_to_end(coarse, checkpoints, f"{name}-coarse"))
            row |= bracket_ends(bracket_first_event(packing, interaction, choices))
        return row

    config = {"law": asdict(law), "shear": asdict(choices), "coarse_run": coarse_run}
    return response_block(packings, "shear", config, law, sample)
