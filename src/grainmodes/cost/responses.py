"""The cost of what grids ask of their packings: one item per stage, grid and n."""

from __future__ import annotations

from collections.abc import Iterator

from grainmodes.configuration import Grid, Scene
from grainmodes.cost.item import Item, Job
from grainmodes.cost.table import Table
from grainmodes.cost.work import degrees_of_freedom, work
from grainmodes.parameters.grid import Point, parse_seeds, seed_blocks
from grainmodes.parameters.stage import Observables
from grainmodes.parameters.stages import STAGES, requested

NUMBERS = {"counts": 0, "binned_averages": 0, "eigenvalues": 1, "modes": 3}
"""Numbers per mode that a kind of spectrum stores."""

COPIES = 3
"""A number of a sample stands in its block, in its point and in the ensemble."""


def responses(scene: Scene, table: Table, place: int) -> Iterator[Item]:
    """The stages of the grid at this place of the scene, those of one sample included."""
    grid = scene.grids[place]
    sizes = [len(parse_seeds(block)) for block in seed_blocks(grid.seeds, scene.seeds_per_job)]
    for n in grid.n:
        for stage, points in _stages(grid, n).items():
            size = [1] if STAGES[stage].single_sample else sizes
            yield _response(scene, table, place, stage, points, size)


def _points(grid: Grid, n: int) -> list[Point]:
    return [point for point in grid.points if point.n == n]


def _stages(grid: Grid, n: int) -> dict[str, list[Point]]:
    """Stage → the points of one n that ask for it."""
    found: dict[str, list[Point]] = {}
    for point in _points(grid, n):
        for stage in requested(grid.observables, point.kt):
            found.setdefault(stage.name, []).append(point)
    return found


def _response(
    scene: Scene, table: Table, place: int, stage: str, points: list[Point], sizes: list[int]
) -> Item:
    """A stage at some points, each in blocks of so many samples."""
    observables = scene.grids[place].observables
    chains = [
        [response_job(scene, table, stage, observables, point, size)]
        for point in points
        for size in sizes
    ]
    return Item.from_chains(stage, place, points[0].n, chains, table)


def response_job(
    scene: Scene, table: Table, stage: str, observables: Observables, point: Point, samples: int
) -> Job:
    """A stage on so many samples of a point that has these observables."""
    kind = str(observables["spectrum"])
    units = work(stage, kind, point.n, point.kt, scene.protocol, table)
    return Job.from_units(
        table,
        units,
        point.n,
        samples,
        _stored(stage, kind, point, table),
        shareable=STAGES[stage].parallel and all(name.startswith("window") for name in units),
    )


def _stored(stage: str, kind: str, point: Point, table: Table) -> float:
    """Bytes per sample that grow with N."""
    if stage not in ("spectrum", "spectrum_rattlers"):
        return 0.0
    numbers = COPIES * NUMBERS[kind] * degrees_of_freedom(point.n, point.kt)
    return numbers * table.disk["number"]
