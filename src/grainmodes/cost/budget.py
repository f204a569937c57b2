"""What a scene may cost at most: what no machine gives is refused before it is planned."""

from __future__ import annotations

from collections.abc import Iterator

from grainmodes.configuration import ConfigurationError, Scene
from grainmodes.cost.estimate import estimate
from grainmodes.cost.item import Item
from grainmodes.cost.table import Table

MAX_JOB_HOURS, MAX_JOB_GIGABYTES = 1_000.0, 1_000.0
"""Largest CPU time and memory of a job."""

MAX_HOURS, MAX_TERABYTES = 1_000_000.0, 100.0
"""Largest CPU time of a scene, and its largest size on disk."""


def check_budget(scene: Scene, table: Table) -> None:
    """Refuse a scene of which a job, or the whole, costs more than any machine gives.

    Raises:
        ConfigurationError: with a line for every stage that does.
    """
    items = estimate(scene, table)
    found = [sentence for item in items for sentence in _of_job(item)] or list(_of_scene(items))
    if found:
        raise ConfigurationError("\n".join(found))


def _of_job(item: Item) -> Iterator[str]:
    hours, gigabytes = item.seconds / item.jobs / 3600.0, item.megabytes / 1000.0
    if hours > MAX_JOB_HOURS or gigabytes > MAX_JOB_GIGABYTES:
        grid = "grids" if item.grid is None else f"grids[{item.grid}]"
        yield (
            f"{grid}: expected jobs of at most {MAX_JOB_HOURS:.0f} CPU hours and "
            f"{MAX_JOB_GIGABYTES:.0f} GB, got {hours:.3g} CPU hours and {gigabytes:.3g} GB for "
            f"{item.stage} at n = {item.n}"
        )


def _of_scene(items: list[Item]) -> Iterator[str]:
    hours = sum(item.seconds for item in items) / 3600.0
    terabytes = sum(item.disk for item in items) / 1e12
    if hours > MAX_HOURS or terabytes > MAX_TERABYTES:
        yield (
            f"grids: expected a scene of at most {MAX_HOURS:.3g} CPU hours and "
            f"{MAX_TERABYTES:.0f} TB, got {hours:.3g} CPU hours and {terabytes:.3g} TB"
        )
