"""A plan in words: a row per point and quantity, then what cannot be planned."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import TYPE_CHECKING

from grainmodes.cost.table import Table
from grainmodes.planning.hours import protocol_of, seconds_per_seed
from grainmodes.planning.quantities import Left, Plan, Point, planned
from grainmodes.planning.seeds import CONFIDENCE, LEAST

if TYPE_CHECKING:
    import xarray as xr

COLUMNS = f"{'n':>6} {'phi':>7} {'k_T':>7}  {'quantity':14} {'pilot':>5} {'error':>7} "
COLUMNS += f"{'seeds':>9} {f'{100 * CONFIDENCE:.0f} % interval':>21} {'CPU h':>8}  bin, omega t_0"


def report(ensemble: xr.Dataset, target: float, table: Table) -> str:
    """The plan of every point as lines of text, the last without an end of line.

    Args:
        target: relative standard error, as 0.01 for 1 %.

    Raises:
        BlockError: the ensemble holds neither g nor spectra.
        ValueError: nothing can be planned from it.
    """
    found = {point: planned(ensemble, point, target) for point in _points(ensemble)}
    if not any(isinstance(of, Plan) for plans in found.values() for of in plans):
        raise ValueError(
            f"expected a point with at least {LEAST} converged seeds and a mean other than 0, "
            "got none"
        )
    return "\n".join(_lines(found, target, protocol_of(ensemble), table))


def _points(ensemble: xr.Dataset) -> list[Point]:
    """The points that any sample belongs to: a study of several grids is no full product."""
    there = ensemble["converged"].notnull().any("seed").transpose("n", "phi", "kt").to_numpy()
    axes = [ensemble[name].to_numpy().tolist() for name in ("n", "phi", "kt")]
    return [point for point, here in zip(product(*axes), there.ravel(), strict=True) if here]


def _lines(found: dict, target: float, protocol, table: Table) -> Iterator[str]:
    yield f"seeds for a relative standard error of {100 * target:g} %"
    yield ""
    yield COLUMNS
    for point, plans in found.items():
        for of in plans:
            if isinstance(of, Plan):
                seconds = seconds_per_seed(point, of.kind, protocol, table)
                yield _row(point, of, seconds)
    yield ""
    for point, plans in found.items():
        yield from (f"{_named(point)}: {of.sentence}" for of in plans if isinstance(of, Left))
    yield "pilot: seeds behind a row; error: the relative standard error that they reach"
    yield "interval: chi-square of the variance; the worst bin is the largest of many estimates"
    yield f"CPU h: each point alone, one thread of {table.machine}"


def _row(point: Point, plan: Plan, seconds: float) -> str:
    n, phi, kt = point
    need = plan.need
    interval = f"{need.low:.0f} to {need.high:.0f}"
    place = f"  {plan.place[0]:.3g}–{plan.place[1]:.3g}" if plan.place else ""
    head = f"{n:6d} {phi:7g} {kt:7g}  {plan.quantity:14} {plan.samples:5d} {need.error:7.2%}"
    return f"{head} {need.seeds:9.0f} {interval:>21} {need.seeds * seconds / 3600:8.3g}{place}"


def _named(point: Point) -> str:
    return ", ".join(
        f"{name} = {of:g}" for name, of in zip(("n", "phi", "k_T"), point, strict=True)
    )
