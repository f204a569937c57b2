"""Gathers blocks of samples into points, and points into one ensemble, and reads it.

`averages` has means with errors, `spectra` the modes of a point, `curves` its stress-strain curves,
`exceptional` the births and deaths of complex pairs, `lost` the
samples without a whole result.
"""

from grainmodes.ensemble.point import gather_point, merge_blocks
from grainmodes.ensemble.reading import (
    bin_density,
    configuration,
    contact_law,
    normal_law,
    open_ensemble,
)
from grainmodes.ensemble.study import write_ensemble

__all__ = [
    "bin_density",
    "configuration",
    "contact_law",
    "gather_point",
    "merge_blocks",
    "normal_law",
    "open_ensemble",
    "write_ensemble",
]
