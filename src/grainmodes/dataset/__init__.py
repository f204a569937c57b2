"""Blocks of samples on disk: one netCDF file per (point, block of seeds), and what its names mean.

`VARIABLES` is the one table of names; its rows stand in a module per theme.
"""

from __future__ import annotations

from grainmodes.dataset import (
    claim_diagnostics,
    complex_pairs,
    event_detail,
    fields,
    law_comparison,
    packing,
    release,
    rigidity,
    shear,
    spectrum,
)
from grainmodes.dataset.variable import Variable

VARIABLES: dict[str, Variable] = {
    name: row
    for theme in (
        packing,
        rigidity,
        spectrum,
        claim_diagnostics,
        fields,
        shear,
        event_detail,
        complex_pairs,
        release,
        law_comparison,
    )
    for name, row in theme.NAMES.items()
}
"""Every name that a block or an ensemble may hold."""
