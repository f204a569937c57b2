"""Small scenes that tests change key by key or grid by grid."""

from copy import deepcopy
from pathlib import Path

from grainmodes.configuration import scene_from

CONFIG = Path(__file__).parents[2] / "config"
"""The folder of the scenes that come with the study."""

GRID = {"n": [16, 64], "phi": [0.84, 0.9], "kt": [1e-4, 1.0], "seeds": 4}
FRICTIONLESS = {"kt": [0.0]}
ONLY_SPECTRA = {"observables": {"rigidity": False, "spectrum": "counts"}}
ONLY_G = {"observables": {"spectrum": "none"}}
WITH_RATTLERS = {"observables": {"rattlers": True}}
WITH_HESSIAN = {"observables": {"hessian": True}, "n": [128]}


def scene_with(path: str | None = None, value=None):
    """The scene of a small configuration with one key set; the value `...` removes the key.

    A path that starts with `grid` leads into the only grid.
    """
    config = {"study": "small", "grids": [deepcopy(GRID)]}
    if path is not None:
        *parents, last = path.split(".")
        room = config
        for name in parents:
            room = config["grids"][0] if name == "grid" else room.setdefault(name, {})
        room[last] = value
        if value is ...:
            del room[last]
    return scene_from(config)


def scene_of_grids(*changes: dict, **keys):
    """The scene of the small grid once for every dictionary of changes."""
    return scene_from({"study": "small", "grids": [GRID | change for change in changes], **keys})
