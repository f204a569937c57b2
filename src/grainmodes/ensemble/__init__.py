"""From blocks of samples to points, from points to one ensemble.

Its averages: `averages`; its spectra: `spectra`.
"""

from grainmodes.ensemble.point import gather_point, merge_blocks
from grainmodes.ensemble.reading import bin_density, configuration, normal_law, open_ensemble
from grainmodes.ensemble.study import write_ensemble

__all__ = [
    "bin_density",
    "configuration",
    "gather_point",
    "merge_blocks",
    "normal_law",
    "open_ensemble",
    "write_ensemble",
]
