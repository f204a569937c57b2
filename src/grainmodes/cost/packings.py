"""The cost of trajectories and packings: they belong to (n, φ, seeds) and serve all grids.

Those compressed with friction belong to (n, φ, k_T, seeds).

A trajectory is a chain of jobs from checkpoint to checkpoint, up to the highest φ that a grid asks
of its seeds; a packing goes on from the checkpoint below it and is then balanced.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from grainmodes.configuration import Scene
from grainmodes.cost.item import Item, Job
from grainmodes.cost.table import Table
from grainmodes.parameters.compression import PREPARATIONS
from grainmodes.parameters.grid import (
    CHECKPOINT_SPACING,
    LOWEST_CHECKPOINT,
    Point,
    checkpoint_at_or_below,
    checkpoints_up_to,
    parse_seeds,
    seed_blocks,
)
from grainmodes.parameters.stages import STAGES, packings_stage

TRAJECTORY = {"compress": "trajectory", "compress_with_friction": "frictional_trajectory"}
"""Stage of a compression → its growth law, of a whole trajectory to φ = 0.90."""


def packings(scene: Scene, table: Table, n: int) -> Iterator[Item]:
    """The stages that compress n grains and balance them, with and without friction."""
    for preparation in PREPARATIONS:
        stage = packings_stage(preparation)
        files = _files(scene, n, preparation)
        top = {(file.kt, file.seeds): file for file in files}.values()  # the highest comes last
        if files:
            climbs = [
                [
                    checkpoint_job(scene, table, stage.reads, Point(n, phi, file.kt), file.samples)
                    for phi in checkpoints_up_to(file.phi)
                ]
                for file in top
            ]
            yield Item.from_chains(stage.reads, None, n, climbs, table)
            jobs = [
                packing_job(scene, table, stage.name, Point(n, file.phi, file.kt), file.samples)
                for file in files
            ]
            yield Item.from_chains(stage.name, None, n, [[job] for job in jobs], table)


def checkpoint_job(scene: Scene, table: Table, stage: str, point: Point, samples: int) -> Job:
    """The compression to the checkpoint φ from the one below it, or from random placement."""
    below = replace(point, phi=round(point.phi - CHECKPOINT_SPACING, 12))
    start = 0.0 if below.phi < LOWEST_CHECKPOINT else _behind(scene, table, stage, below)
    part = _behind(scene, table, stage, point) - start
    disk = point.n * table.disk["trajectory"]
    return Job.from_units(table, {TRAJECTORY[stage]: part}, point.n, samples, disk)


def packing_job(scene: Scene, table: Table, stage: str, point: Point, samples: int) -> Job:
    """From the checkpoint below φ to φ, and into force balance."""
    read, n = STAGES[stage].reads, point.n
    start = replace(point, phi=checkpoint_at_or_below(point.phi))
    below, above = (_behind(scene, table, read, at) for at in (start, point))
    job = Job.from_units(table, {stage: 1.0}, n, samples, n * table.disk["packing"])
    climb = samples * (above - below) * table.growth_law(TRAJECTORY[read]).seconds_at(n)
    return replace(job, seconds=job.seconds + climb)


def _behind(scene: Scene, table: Table, stage: str, point: Point) -> float:
    """The part of a usual trajectory, in its time, that is behind a compression at φ."""
    with_friction = STAGES[stage].needs_friction
    slowdown = table.slowdown(scene.protocol.compression, with_friction, point.kt)
    return slowdown * table.share(point.phi, with_friction)


class File(NamedTuple):
    """A file of packings; `kt` is 0 where all k_T share it."""

    phi: float
    kt: float
    seeds: str

    @property
    def samples(self) -> int:
        """How many."""
        return len(parse_seeds(self.seeds))


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
