"""One point of the grid from nothing to its numbers, in memory: what a study does in files."""

from __future__ import annotations

from grainmodes.dataset.files import Block
from grainmodes.ensemble.point import merge_blocks
from grainmodes.parameters.compression import PREPARATIONS
from grainmodes.parameters.grid import checkpoints_up_to
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.stage import Observables
from grainmodes.parameters.stages import STAGES, packings_stage, requested
from grainmodes.stages import load


def point_block(
    n: int,
    phi: float,
    law: ContactLaw,
    seeds: range,
    protocol: Protocol,
    observables: Observables,
    preparation: str = PREPARATIONS[0],
) -> Block:
    """Every requested observable of the point (n, φ, k_T) that a point gathers, for some seeds.

    The packings go through the same checkpoints as in a study, so the numbers are the same.
    """
    last = packings_stage(preparation)
    first = STAGES[last.reads]
    keywords = first.keywords(protocol, observables)
    keywords |= {"law": law} if first.needs_friction else {"normal": law.normal}
    start: Block | None = None
    for checkpoint in checkpoints_up_to(phi):
        start = load(first.function)(n=n, seeds=seeds, phi=checkpoint, start=start, **keywords)
    assert start is not None  # every phi lies above a checkpoint
    packings = load(last.function)(start=start, phi=phi, **keywords)
    made = {STAGES["equilibrate"].name: packings}
    for stage in requested(observables, law.kt):
        if not stage.single_sample:
            given = stage.keywords(protocol, observables)
            made[stage.name] = load(stage.function)(made[stage.reads], law, **given)
    return merge_blocks(made)
