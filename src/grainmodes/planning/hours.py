"""CPU seconds of one seed of a point, from the growth laws of `grainmodes.cost`.

    from random grains to φ + the final balance + g + the spectrum, where the quantity needs it

A point is priced alone. In a study its packings serve every k_T, and its trajectory every φ below.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grainmodes.configuration import scene_of
from grainmodes.cost.table import Table
from grainmodes.cost.work import work
from grainmodes.ensemble import configuration
from grainmodes.parameters.protocol import Protocol
from grainmodes.planning.quantities import Point

if TYPE_CHECKING:
    import xarray as xr

ANY_GRID = {"n": [64], "phi": [0.9], "kt": [0.0], "seeds": 1}
"""A valid grid: what it says is not used."""


def protocol_of(ensemble: xr.Dataset) -> Protocol:
    """The numerical choices of a pilot; defaults where its configuration is silent."""
    choices = configuration(ensemble).get("protocol", {})
    return scene_of({"study": "pilot", "grids": [ANY_GRID], "protocol": choices}).protocol


def seconds_per_seed(point: Point, kind: str, protocol: Protocol, table: Table) -> float:
    """CPU seconds from random grains to G or, with a kind of spectrum, to D(ω)."""
    n, phi, kt = point
    climb = table.laws["trajectory"].seconds_at(n) * table.slowdown(protocol.compression)
    packing = climb * table.share(phi) + table.laws["equilibrate"].seconds_at(n)
    stage = "rigidity" if kind == "none" else "spectrum"
    units = work(stage, kind, n, kt, protocol, table)
    return packing + sum(times * table.laws[name].seconds_at(n) for name, times in units.items())
