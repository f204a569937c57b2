"""Small scenes and what they cost: CPU seconds and jobs, stage by stage."""

from dataclasses import replace

from grainmodes.cost import estimate, read_table
from scenes import scene_of_grids

TABLE = read_table()
FREE = replace(TABLE, job={"seconds": 0.0, "megabytes": 180.0})
ONLY_G = {"step_strain": False, "spectrum": "none"}
GRID = {"n": [64], "phi": [0.85, 0.9], "kt": [1e-4, 1.0], "seeds": 4, "observables": ONLY_G}


def scene_with(*changes: dict, **keys):
    """A scene of the small grid, once for every dictionary of changes."""
    return scene_of_grids(*(GRID | change for change in changes), **keys)


def observing(**observables) -> dict:
    """A change of the observables of the small grid."""
    return {"observables": ONLY_G | observables}


def seconds_of_stage(scene, stage: str, table=FREE) -> float:
    """CPU seconds of a stage."""
    return sum(item.seconds for item in estimate(scene, table) if item.stage == stage)


def total(scene) -> float:
    """CPU seconds of a scene, start-up of jobs aside."""
    return sum(item.seconds for item in estimate(scene, FREE))


def jobs(scene) -> dict[str, int]:
    """Stage → number of jobs."""
    found: dict[str, int] = {}
    for item in estimate(scene, TABLE):
        found[item.stage] = found.get(item.stage, 0) + item.jobs
    return found
