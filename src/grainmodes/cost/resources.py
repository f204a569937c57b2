"""What a job asks a scheduler for: threads, memory, and time after which it may be ended.

| asked for | from the growth laws of the job: its n, block of seeds and settings                |
| --------- | ---------------------------------------------------------------------------------- |
| threads   | one per hour of CPU time where processes can share it, at most `MOST_THREADS`      |
| megabytes | `MEMORY_MARGIN` times the peak of its processes, and room to compile the kernels   |
| minutes   | `TIME_MARGIN` times its CPU time, shared by its threads, and time to compile       |

A job that was ended all the same, or failed, asks for twice as much memory and time at its next
attempt. Nothing here imports numpy, because a workflow asks for every job.
"""

from __future__ import annotations

import math
from collections.abc import Collection

from grainmodes.configuration import Scene
from grainmodes.cost.item import Job
from grainmodes.cost.packings import TRAJECTORY, checkpoint_job, packing_job
from grainmodes.cost.responses import response_job
from grainmodes.cost.table import Table
from grainmodes.cost.work import degrees_of_freedom
from grainmodes.parameters.grid import Point
from grainmodes.parameters.stages import STAGES

MOST_THREADS = 8
"""Processes that one job starts at most; its slices are shared out evenly up to there."""

SECONDS_PER_THREAD = 3600.0
"""CPU time from which a job takes another thread, where its work can be shared."""

LARGEST_DENSE = 4096
"""Largest N at which `measurements/` compares with a dense spectrum."""

STATE_NUMBERS = 20
"""Numbers that a point keeps of a state of a shear, its pairs of eigenvalues included."""

MEMORY_MARGIN = 1.5
TIME_MARGIN = 4.0
"""A cluster's core may be half as fast as the one that was measured, and runs beside others."""


def stage_job(scene: Scene, table: Table, stage: str, point: Point, samples: int) -> Job:
    """A stage of the table on so many samples of a point; packings are the same for every k_T.

    A spectrum at a point that requests none has all modes, as `Scene.settings` says.
    """
    if stage in TRAJECTORY:
        return checkpoint_job(scene, table, stage, point, samples)
    if not STAGES[stage].observable:
        return packing_job(scene, table, stage, point, samples)
    observables = dict(scene.grid_at(point.n, point.phi, point.kt).observables)
    if observables["spectrum"] == "none":
        observables["spectrum"] = "modes"
    return response_job(scene, table, stage, observables, point, samples)


def gather_job(scene: Scene, table: Table, points: Collection[Point], files: int) -> Job:
    """A job that gathers so many files, of one point or of several, one point after the other."""
    law = table.gathering
    samples = {point: scene.grid_at(point.n, point.phi, point.kt).seeds for point in points}
    numbers = max(count * _numbers(scene, point) for point, count in samples.items())
    total = sum(samples.values())
    seconds = files * law["file_seconds"] + total * law["sample_seconds"]
    return Job(total, seconds, law["copies"] * 8e-6 * numbers, 0.0, up_to=0)


def _numbers(scene: Scene, point: Point) -> float:
    """About how many numbers a point keeps of a sample: of its modes, and of states of shear."""
    observables = scene.grid_at(point.n, point.phi, point.kt).observables
    modes = 3 * degrees_of_freedom(point.n, point.kt) if observables["spectrum"] != "none" else 0
    sheared = observables["shear"] or observables["complex_pairs"]
    shear = scene.protocol.shear
    return modes + (STATE_NUMBERS * shear.strain / shear.step if sheared else 0)


def reader_job(scene: Scene, table: Table) -> Job:
    """A job that reads the ensemble: the checks, the claims, a figure."""
    law, megabytes = table.gathering, padded_megabytes(scene)
    seconds = megabytes * law["seconds_per_megabyte"]
    return Job(0, seconds, law["copies"] * megabytes, 0.0, up_to=0)


def measurement_job(table: Table, n: int, seconds: float) -> Job:
    """A job that measures speeds or errors up to n grains, dense spectra up to `LARGEST_DENSE`."""
    dense = table.growth_law("dense_modes").megabytes_at(min(n, LARGEST_DENSE))
    peak = max(dense, table.growth_law("rigidity").megabytes_at(n))
    return Job(1, seconds, peak, 0.0, up_to=n)


def padded_megabytes(scene: Scene) -> float:
    """One number per mode of every sample in an ensemble: n × φ × k_T × seeds × modes, in MB."""
    grid = [
        len({value for grid in scene.grids for value in getattr(grid, name)})
        for name in ("n", "phi", "kt")
    ]
    seeds = max(grid.seeds for grid in scene.grids)
    modes = max(degrees_of_freedom(point.n, point.kt) for point in scene.points)
    return math.prod(grid) * seeds * modes * 8e-6


def threads(job: Job) -> int:
    """How many threads a job asks for."""
    if not job.shareable:
        return 1
    return min(MOST_THREADS, max(1, math.ceil(job.seconds / SECONDS_PER_THREAD)))


def megabytes(job: Job, table: Table, granted: int = 1, attempt: int = 1) -> int:
    """Memory of a job that was granted so many threads; processes that share hold their own."""
    processes = 1 + granted if job.shareable and granted > 1 else 1
    peak = processes * (table.job["megabytes"] + job.megabytes)
    asked = MEMORY_MARGIN * peak + table.compilation["megabytes"]
    return 2 ** (attempt - 1) * math.ceil(asked)


def minutes(job: Job, table: Table, granted: int = 1, attempt: int = 1) -> int:
    """Minutes after which a job that was granted so many threads may be ended."""
    shared = job.seconds / (granted if job.shareable else 1)
    asked = TIME_MARGIN * (shared + table.job["seconds"]) + table.compilation["seconds"]
    return 2 ** (attempt - 1) * math.ceil(asked / 60)
