"""Blocks of samples on disk: one netCDF file per (point, block of seeds), and what its names mean.

`VARIABLES` is the one table of names; its rows stand in a module per theme.
"""

from __future__ import annotations

from grainmodes.dataset import (
    close_up,
    fields,
    packing,
    pairs,
    probes,
    release,
    rigidity,
    shear,
    spectrum,
    variants,
)
from grainmodes.dataset.variable import Variable

VARIABLES: dict[str, Variable] = {
    name: row
    for theme in (
        packing,
        rigidity,
        spectrum,
        probes,
        fields,
        shear,
        close_up,
        pairs,
        release,
        variants,
    )
    for name, row in theme.NAMES.items()
}
"""Every name that a block or an ensemble may hold."""
