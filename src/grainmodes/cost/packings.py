"""The cost of trajectories and packings: they belong to (n, φ, seeds) and serve all grids.

A trajectory is a chain of jobs from checkpoint to checkpoint, up to the highest φ that a grid asks
of its seeds; a packing goes on from the checkpoint below it and is then balanced.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from grainmodes.configuration import Scene
from grainmodes.cost.item import Item, Job
from grainmodes.cost.table import Table
from grainmodes.parameters.grid import (
    checkpoint_at_or_below,
    checkpoints_up_to,
    parse_seeds,
    seed_blocks,
)


def packings(scene: Scene, table: Table, n: int) -> Iterator[Item]:
    """The stages compress and equilibrate at n grains."""
    files = _files(scene, n)
    whole = table.laws["trajectory"].seconds_at(n) * table.slowdown(scene.protocol.compression)
    yield _compress(table, n, whole, files)
    yield _equilibrate(table, n, whole, files)


def _files(scene: Scene, n: int) -> list[tuple[float, str]]:
    """φ and block of seeds of every file of packings, each once."""
    asked = {
        (phi, block)
        for grid in scene.grids
        if n in grid.n
        for phi in grid.phi
        for block in seed_blocks(grid.seeds, scene.seeds_per_job)
    }
    return sorted(asked)


def _compress(table: Table, n: int, whole: float, files: list[tuple[float, str]]) -> Item:
    top = {block: phi for phi, block in files}  # the highest comes last

    def climb(size: int, phi: float) -> list[Job]:
        checkpoints = checkpoints_up_to(phi)
        behind = [0.0, *map(table.share, checkpoints)]
        parts = [after - before for before, after in pairwise(behind)]
        disk = size * n * table.disk["trajectory"]
        return [Job(size, size * whole * part, disk) for part in parts]

    chains = [climb(len(parse_seeds(block)), phi) for block, phi in top.items()]
    return Item.from_chains("compress", None, n, chains, [table.laws["trajectory"]], table)


def _equilibrate(table: Table, n: int, whole: float, files: list[tuple[float, str]]) -> Item:
    balance = table.laws["equilibrate"].seconds_at(n)

    def branch(size: int, phi: float) -> Job:
        way = table.share(phi) - table.share(checkpoint_at_or_below(phi))
        return Job(size, size * (whole * way + balance), size * n * table.disk["packing"])

    chains = [[branch(len(parse_seeds(block)), phi)] for phi, block in files]
    return Item.from_chains("equilibrate", None, n, chains, [table.laws["equilibrate"]], table)
