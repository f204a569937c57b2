"""The stage `shear`: every packing of a block sheared quasistatically, with its events."""

from __future__ import annotations

from dataclasses import asdict, replace
from functools import partial

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import bracket_first_event, refined_steps
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.stages.long_runs import CheckpointStore, run_to_end
from grainmodes.stages.rows import SAMPLE_ERRORS, loss, response_block
from grainmodes.stages.samples import jammed_packing, seed_of
from grainmodes.stages.shear_rows import (
    bracket_ends,
    bracket_failures,
    coarse_run_row,
    history_row,
    last_path_row,
    rate_row,
    run_row,
)


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
        coarse_run: adds a run in steps Δγ_in whose events are not bracketed, the first event in
            brackets of every width with dq̊/dγ after it, and what the springs remember up to there.
        checkpoints: where runs are saved now and then; a sample takes minutes to hours.
    """
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        if not jammed:
            return {"curve_count": 0, "jammed": False, "converged": True}
        start, name = QuasistaticRun.from_packing, f"seed-{seed_of(packings, number)}"
        run = run_to_end(partial(start, packing, interaction, choices), checkpoints, name)
        row = run_row(run)
        errors: dict[str, Exception | None] = {"": None if run.done else run.failure}
        if coarse_run:
            begin = partial(start, packing, interaction, replace(choices, min_step=choices.step))
            coarse = run_to_end(begin, checkpoints, f"{name}-coarse")
            brackets = bracket_first_event(packing, interaction, choices)
            row |= coarse_run_row(coarse) | bracket_ends(brackets)
            errors |= {"coarse run": None if coarse.done else coarse.failure}
            errors |= bracket_failures(brackets)
            for part, further in {
                "closed loop": partial(history_row, packing, interaction, choices),
                "tangential path": partial(last_path_row, packing, interaction, choices),
                "rate after the event": partial(rate_row, brackets[-1], refined_steps(choices)[-1]),
            }.items():
                try:
                    row |= further()
                except SAMPLE_ERRORS as error:
                    errors[part] = error
        lost = loss(errors)
        return row | {"converged": not lost} | lost

    config = {"law": asdict(law), "shear": asdict(choices), "coarse_run": coarse_run}
    return response_block(packings, "shear", config, law, sample)
