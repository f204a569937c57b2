"""CPU seconds of one seed of a point, from the growth laws of `grainmodes.cost`.

    from random grains to φ + the final force balance + g + the spectrum, if the quantity needs it

The price is that of a point by itself. In a study all lower φ share its trajectory, and all k_T its
packings, unless they are compressed with friction.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grainmodes.configuration import stage_settings
from grainmodes.cost.packings import TRAJECTORY
from grainmodes.cost.table import Table
from grainmodes.cost.work import work
from grainmodes.ensemble import configuration
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.stages import packings_stage
from grainmodes.planning.quantities import PointCoordinates

if TYPE_CHECKING:
    import xarray as xr


def protocol_of(ensemble: xr.Dataset) -> Protocol:
    """The numerical choices of a pilot, with the defaults for all that its configuration omits."""
    choices = configuration(ensemble).get("protocol", {})
    return stage_settings({"protocol": choices}).protocol


def preparation_of(ensemble: xr.Dataset, point: PointCoordinates) -> str:
    """How the packings of a point of a pilot were compressed."""
    samples = ensemble.sel(dict(zip(("n", "phi", "kt"), point, strict=True)))
    flag = samples.get("compressed_with_friction")
    return "frictional" if flag is not None and bool((flag == 1).any()) else "frictionless"


def seconds_per_seed(
    point: PointCoordinates, kind: str, preparation: str, protocol: Protocol, table: Table
) -> float:
    """CPU seconds from random grains to G or, if `kind` is a kind of spectrum, to D(ω)."""
    n, phi, kt = point
    last = packings_stage(preparation)
    climb = table.laws[TRAJECTORY[last.reads]].seconds_at(n)
    climb *= table.slowdown(protocol.compression, last.needs_friction, kt)
    packing = climb * table.share(phi, last.needs_friction)
    packing += table.growth_law(last.name).seconds_at(n)
    stage = "rigidity" if kind == "none" else "spectrum"
    units = work(stage, kind, n, kt, protocol, table)
    return packing + sum(times * table.laws[name].seconds_at(n) for name, times in units.items())
