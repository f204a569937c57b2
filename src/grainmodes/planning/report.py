"""A plan as text: a row for every point and quantity, then remarks on what cannot be planned."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import TYPE_CHECKING

from grainmodes.cost.table import Table
from grainmodes.planning.hours import preparation_of, protocol_of, seconds_per_seed
from grainmodes.planning.quantities import Plan, PointCoordinates, Remark, plan_point
from grainmodes.planning.seeds import CONFIDENCE, MIN_SEEDS

if TYPE_CHECKING:
    import xarray as xr

COLUMNS = f"{'n':>6} {'phi':>7} {'k_T':>7}  {'quantity':14} {'pilot':>5} {'error':>7} "
COLUMNS += f"{'seeds':>9} {f'{100 * CONFIDENCE:.0f} % interval':>21} {'CPU h':>8}  bin, omega t_0"


def report(ensemble: xr.Dataset, target: float, table: Table) -> str:
    """The plan of every point as lines of text, the last without an end of line.

    Args:
        target: relative standard error, such as 0.01 for 1 %.

    Raises:
        BlockError: the ensemble holds neither g nor spectra.
        ValueError: no point has enough converged seeds with a mean that is not 0.
    """
    found = {point: plan_point(ensemble, point, target) for point in _points(ensemble)}
    if not any(isinstance(row, Plan) for rows in found.values() for row in rows):
        raise ValueError(
            f"expected a point with at least {MIN_SEEDS} converged seeds and a mean other than 0, "
            "got none"
        )
    protocol = protocol_of(ensemble)

    def seconds(point: PointCoordinates, plan: Plan) -> float:
        preparation = preparation_of(ensemble, point)
        return seconds_per_seed(point, plan.spectrum, preparation, protocol, table)

    return "\n".join(_lines(found, target, seconds, table.machine))


def _points(ensemble: xr.Dataset) -> list[PointCoordinates]:
    """The points with samples: a study of several grids is not a full product of its axes."""
    computed = ensemble["converged"].notnull().any("seed").transpose("n", "phi", "kt").to_numpy()
    axes = [ensemble[name].to_numpy().tolist() for name in ("n", "phi", "kt")]
    return [point for point, here in zip(product(*axes), computed.ravel(), strict=True) if here]


def _lines(
    found: dict, target: float, seconds: Callable[[PointCoordinates, Plan], float], machine: str
) -> Iterator[str]:
    yield f"seeds for a relative standard error of {100 * target:g} %"
    yield ""
    yield COLUMNS
    for point, rows in found.items():
        for plan in (row for row in rows if isinstance(row, Plan)):
            yield _row(point, plan, seconds(point, plan))
    yield ""
    for point, rows in found.items():
        remarks = (row for row in rows if isinstance(row, Remark))
        yield from (f"{_point_label(point)}: {remark.sentence}" for remark in remarks)
    yield "pilot: number of its seeds; error: relative standard error that the pilot reaches"
    yield "interval: chi-square of the variance; the worst bin is the largest of many estimates"
    yield f"CPU h: each point by itself, on one thread of {machine}"


def _row(point: PointCoordinates, plan: Plan, seconds: float) -> str:
    n, phi, kt = point
    need = plan.need
    interval = f"{need.low:.0f} to {need.high:.0f}"
    place = f"  {plan.bin[0]:.3g}–{plan.bin[1]:.3g}" if plan.bin else ""
    head = f"{n:6d} {phi:7g} {kt:7g}  {plan.quantity:14} {plan.samples:5d} {need.error:7.2%}"
    return f"{head} {need.seeds:9.0f} {interval:>21} {need.seeds * seconds / 3600:8.3g}{place}"


def _point_label(point: PointCoordinates) -> str:
    n, phi, kt = point
    return f"n = {n:g}, phi = {phi:g}, k_T = {kt:g}"
