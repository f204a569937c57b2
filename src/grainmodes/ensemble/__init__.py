"""Gathers blocks of samples into points, and points into one ensemble, and reads it.

`averages` has means with errors, `spectra` the modes of a point, `curves` its stress-strain curves,
`exceptional` the births and deaths of complex pairs, `law_comparison` the tangential laws side by
side, `trends` κ* and the exponent of G, `lost` the samples without a whole result, `reference` the
ensembles that come with the package.
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
