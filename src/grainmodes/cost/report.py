"""An estimate in words: a row per stage, grid and n, their sum, and how far to trust it."""

from __future__ import annotations

from collections.abc import Iterator

from grainmodes.configuration import Scene
from grainmodes.cost.estimate import estimate, wall_seconds
from grainmodes.cost.item import Item
from grainmodes.cost.table import Table

COLUMNS = f"{'stage':26} {'grid':>5} {'n':>7} {'samples':>8} {'jobs':>6} {'CPU h':>9}"
COLUMNS += f" {'peak MB':>8} {'disk MB':>8}"

MARKS = {
    "*": "* beyond the largest N that was measured: extrapolated",
    "?": "? never measured: a guess",
}


def report(scene: Scene, table: Table, cores: int) -> str:
    """The estimate of a scene as lines of text, the last without an end of line."""
    return "\n".join(_lines(scene, table, cores))


def _lines(scene: Scene, table: Table, cores: int) -> Iterator[str]:
    items = estimate(scene, table)
    yield f"{scene.study}: {len(scene.points)} points on {len(scene.grids)} grids"
    yield ""
    yield COLUMNS
    yield from map(_row, items)
    yield _total(items)
    yield ""
    yield f"wall time on {cores} cores: {spoken(wall_seconds(items, cores))}"
    yield f"CPU time of one thread on {table.machine}; every packing taken as jammed"
    yield from (MARKS[mark] for mark in MARKS if any(_mark(item) == mark for item in items))
    if scene.protocol.step_strain.relaxation == "damped":
        yield "step_strain is priced as newton: what damped costs has no law"


def _row(item: Item) -> str:
    grid = "all" if item.grid is None else item.grid
    head = f"{item.stage:26} {grid:>5} {item.n:7d} {item.samples:8d}"
    amounts = _amounts(item.jobs, item.seconds, item.megabytes, item.disk)
    return f"{head} {amounts} {_mark(item)}".rstrip()


def _total(items: list[Item]) -> str:
    jobs = sum(item.jobs for item in items)
    seconds = sum(item.seconds for item in items)
    disk = sum(item.disk for item in items)
    peak = max(item.megabytes for item in items)
    return f"{'total':49} {_amounts(jobs, seconds, peak, disk)}"


def _amounts(jobs: int, seconds: float, megabytes: float, disk: float) -> str:
    return f"{jobs:6d} {_three(seconds / 3600):>9} {megabytes:8.0f} {disk / 1e6:8.0f}"


def _mark(item: Item) -> str:
    if item.up_to == 0:
        return "?"
    return "*" if item.n > item.up_to else " "


def _three(value: float) -> str:
    """Three digits, and no exponent."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}" if value >= 1e-3 else f"{value:.4f}"


def spoken(seconds: float) -> str:
    """A time in the unit that suits it.

    >>> [spoken(s) for s in (59, 90, 7200, 360000)]
    ['59 s', '1.5 min', '2 h', '100 h']
    """
    for size, unit in ((3600, "h"), (60, "min")):
        if seconds >= size:
            return f"{_three(seconds / size)} {unit}"
    return f"{seconds:.0f} s"
