"""From blocks of samples to points, from points to one ensemble, from an ensemble to averages."""

from grainmodes.ensemble.averages import Spectrum, averages, open_ensemble, spectrum
from grainmodes.ensemble.point import gather_point, merge_blocks
from grainmodes.ensemble.study import write_ensemble

__all__ = [
    "Spectrum",
    "averages",
    "gather_point",
    "merge_blocks",
    "open_ensemble",
    "spectrum",
    "write_ensemble",
]
