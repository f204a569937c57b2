"""From blocks of samples to points, from points to one ensemble.

Its averages: `averages`; its spectra: `spectra`.
"""

from grainmodes.ensemble.point import gather_point, merge_blocks
from grainmodes.ensemble.reading import configuration, fineness, normal_law, open_ensemble
from grainmodes.ensemble.study import write_ensemble

__all__ = [
    "configuration",
    "fineness",
    "gather_point",
    "merge_blocks",
    "normal_law",
    "open_ensemble",
    "write_ensemble",
]
