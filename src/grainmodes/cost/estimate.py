"""The items of a scene: as many samples and jobs as its workflow has.

Packings that are not jammed cost less than is said here.
"""

from __future__ import annotations

from collections.abc import Iterable

from grainmodes.configuration import Scene
from grainmodes.cost.item import Item, Job
from grainmodes.cost.packings import packings
from grainmodes.cost.responses import responses
from grainmodes.cost.table import Table


def estimate(scene: Scene, table: Table) -> list[Item]:
    """The cost of every stage of a scene, stages in the order in which data flow."""
    sizes = sorted({n for grid in scene.grids for n in grid.n})
    shared = [item for n in sizes for item in packings(scene, table, n)]
    of_grids = [
        item for place in range(len(scene.grids)) for item in responses(scene, table, place)
    ]
    return [*shared, *of_grids, _gathering(scene, table, sizes[-1])]


def _gathering(scene: Scene, table: Table, largest: int) -> Item:
    """Points, then the ensemble, its checks and figures: little more than starts of jobs."""
    nothing = Job(0, 0.0, 0.0, 0.0, up_to=largest)
    chains = [[nothing] * 3, *([nothing] for _ in [*scene.points[1:], *scene.figures])]
    return Item.from_chains("gather", None, largest, chains, table)


def wall_seconds(items: Iterable[Item], cores: int) -> float:
    """How long a run takes on so many cores: all work shared out, or the longest chain of jobs."""
    items = list(items)
    chains = [_chain([item for item in items if item.n == n]) for n in {i.n for i in items}]
    return max(sum(item.seconds for item in items) / cores, *chains)


def _chain(items: list[Item]) -> float:
    """From random grains to the longest response at one n."""
    shared = sum(item.chain for item in items if item.grid is None)
    return shared + max((item.chain for item in items if item.grid is not None), default=0.0)
