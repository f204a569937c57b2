"""The cost of trajectories and packings: they belong to (n, φ, seeds) and serve all grids.

Those compressed with friction belong to (n, φ, k_T, seeds).

A trajectory is a chain of jobs from checkpoint to checkpoint, up to the highest φ that a grid asks
of its seeds; a packing goes on from the checkpoint below it and is then balanced.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from grainmodes.configuration import Scene
from grainmodes.cost.item import Item, Job
from grainmodes.cost.table import Table
from grainmodes.parameters.compression import PREPARATIONS
from grainmodes.parameters.grid import (
    checkpoint_at_or_below,
    checkpoints_up_to,
    parse_seeds,
    seed_blocks,
)
from grainmodes.parameters.stage import Stage
from grainmodes.parameters.stages import packings_stage

TRAJECTORY = {"compress": "trajectory", "compress_with_friction": "frictional_trajectory"}
"""Stage of a compression → its growth law, of a whole trajectory to φ = 0.90."""


def packings(scene: Scene, table: Table, n: int) -> Iterator[Item]:
    """The stages that compress n grains and balance them, with and without friction."""
    for preparation in PREPARATIONS:
        stage = packings_stage(preparation)
        files = _files(scene, n, preparation)
        if files:
            whole = table.laws[TRAJECTORY[stage.reads]].seconds_at(n)
            whole *= table.slowdown(scene.protocol.compression, stage.needs_friction)
            yield _compress(table, stage, n, whole, files)
            yield _equilibrate(table, stage, n, whole, files)


class File(NamedTuple):
    """A file of packings; `kt` is 0 where all k_T share it."""

    phi: float
    kt: float
    seeds: str


def _files(scene: Scene, n: int, preparation: str) -> list[File]:
    """Every file of packings of n grains, each once, the lowest φ first."""
    asked = {
        File(phi, kt, block)
        for grid in scene.grids
        if n in grid.n and grid.preparation == preparation
        for kt in (grid.kt if preparation == "frictional" else (0.0,))
        for phi in grid.phi
        for block in seed_blocks(grid.seeds, scene.seeds_per_job)
    }
    return sorted(asked)


def _compress(table: Table, stage: Stage, n: int, whole: float, files: list[File]) -> Item:
    top = {(file.kt, file.seeds): file for file in files}.values()  # the highest comes last

    def climb(file: File) -> list[Job]:
        checkpoints, size = checkpoints_up_to(file.phi), len(parse_seeds(file.seeds))
        behind = [0.0, *(table.share(phi, stage.needs_friction) for phi in checkpoints)]
        parts = [after - before for before, after in pairwise(behind)]
        disk = size * n * table.disk["trajectory"]
        return [Job(size, size * whole * part, disk) for part in parts]

    law = table.laws[TRAJECTORY[stage.reads]]
    return Item.from_chains(stage.reads, None, n, [climb(file) for file in top], [law], table)


def _equilibrate(table: Table, stage: Stage, n: int, whole: float, files: list[File]) -> Item:
    law = table.growth_law(stage.name)

    def branch(file: File) -> list[Job]:
        size, ends = len(parse_seeds(file.seeds)), (checkpoint_at_or_below(file.phi), file.phi)
        below, above = (table.share(phi, stage.needs_friction) for phi in ends)
        seconds = whole * (above - below) + law.seconds_at(n)
        return [Job(size, size * seconds, size * n * table.disk["packing"])]

    chains = [branch(file) for file in files]
    return Item.from_chains(stage.name, None, n, chains, [law], table)
