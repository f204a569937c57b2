"""One point of the grid from nothing to its numbers, in memory: what a study does in files."""

from __future__ import annotations

from grainmodes.dataset.files import Block
from grainmodes.ensemble.point import merge_blocks
from grainmodes.parameters.grid import checkpoints_up_to
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.stage import Observables
from grainmodes.parameters.stages import STAGES, requested
from grainmodes.stages import load
from grainmodes.stages.compression import compress_block, packing_block


def point_block(
    n: int, phi: float, law: ContactLaw, seeds: range, protocol: Protocol, observables: Observables
) -> Block:
    """Every requested observable of the point (n, φ, k_T) that a point gathers, for some seeds.

    The packings go through the same checkpoints as in a study, so the numbers are the same.
    """
    start: Block | None = None
    for checkpoint in checkpoints_up_to(phi):
        start = compress_block(n, seeds, checkpoint, protocol.compression, law.normal, start)
    assert start is not None  # every phi lies above a checkpoint
    packings = packing_block(start, phi, protocol.compression, law.normal)
    made = {STAGES["equilibrate"].name: packings}
    for stage in requested(observables, law.kt):
        if not stage.single_sample:
            keywords = stage.keywords(protocol, observables)
            made[stage.name] = load(stage.function)(made[stage.reads], law, **keywords)
    return merge_blocks(made)
