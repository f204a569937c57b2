"""What a job asks a scheduler for: from its growth law, its N and its block of seeds."""

import subprocess
import sys

import pytest

from cost_fixtures import TABLE, observing, scene_with
from grainmodes.cost import estimate
from grainmodes.cost.resources import (
    MEMORY_MARGIN,
    MOST_THREADS,
    TIME_MARGIN,
    gather_job,
    megabytes,
    minutes,
    padded_megabytes,
    reader_job,
    stage_job,
    threads,
)
from grainmodes.parameters.grid import Point
from grainmodes.parameters.stages import STAGES

SLICED = {"spectrum": {"method": "slicing", "factorisation": "superlu"}}


def modes_of(n: int, samples: int = 1):
    """A job that slices the whole spectrum of n grains."""
    scene = scene_with({"n": [n]} | observing(spectrum="modes"), protocol=SLICED)
    return stage_job(scene, TABLE, "spectrum", Point(n, 0.9, 1.0), samples)


def test_jobs_add_up_to_the_estimate():
    asked = observing(
        spectrum="modes", rattlers=True, hessian=True, shear=True, claim_diagnostics=True
    )
    grid = {"n": [256], "phi": [0.845], "kt": [1.0], "seeds": 6} | asked
    scene = scene_with(grid, seeds_per_job=4)
    items = {item.stage: item for item in estimate(scene, TABLE)}
    for stage in items.keys() - {"gather"}:
        fractions = [0.8, 0.81, 0.82, 0.83, 0.84] if stage == "compress" else [0.845]
        jobs = [
            stage_job(scene, TABLE, stage, Point(256, phi, 1.0), samples)
            for phi in fractions
            for samples in (4, 2)
        ]
        seconds = sum(job.seconds + TABLE.job["seconds"] for job in jobs)
        assert seconds == pytest.approx(items[stage].seconds), stage
        assert TABLE.job["megabytes"] + jobs[0].megabytes == pytest.approx(items[stage].megabytes)


@pytest.mark.parametrize("stage", [stage for stage in STAGES if stage != "release"])
def test_every_stage_asks_for_more_at_a_larger_n(stage):
    scene = scene_with({"n": [64, 4096]})
    small, large = (
        stage_job(scene, TABLE, stage, Point(n, 0.9, 1.0), samples=1) for n in (64, 4096)
    )
    assert minutes(large, TABLE) >= minutes(small, TABLE)
    assert megabytes(large, TABLE) >= megabytes(small, TABLE)
    if stage != "fields":  # as measured, it does not grow
        assert large.seconds > small.seconds
        assert large.megabytes > small.megabytes


def test_a_block_takes_the_time_of_its_samples_and_the_memory_of_one():
    one, ten = modes_of(4096), modes_of(4096, samples=10)
    assert ten.seconds == pytest.approx(10 * one.seconds)
    assert ten.megabytes == one.megabytes


def test_a_request_has_margins_and_doubles_with_every_attempt():
    job = modes_of(4096)
    peak = TABLE.job["megabytes"] + job.megabytes
    assert megabytes(job, TABLE) >= MEMORY_MARGIN * peak
    assert 60 * minutes(job, TABLE) >= TIME_MARGIN * job.seconds
    for asked in (megabytes, minutes):
        first, second, third = (asked(job, TABLE, attempt=k) for k in (1, 2, 3))
        assert (second, third) == (2 * first, 4 * first)


def test_long_slices_are_shared_each_process_with_its_memory():
    short, long = modes_of(2048), modes_of(65536, samples=2)
    assert threads(short) == 1
    assert threads(long) == MOST_THREADS
    assert minutes(long, TABLE, granted=8) < minutes(long, TABLE, granted=1) / 4
    alone, shared = megabytes(long, TABLE, granted=1), megabytes(long, TABLE, granted=8)
    assert shared > 8 * (alone - TABLE.compilation["megabytes"])


@pytest.mark.parametrize("observables", [{"spectrum": "counts"}, {"hessian": True}])
def test_what_is_not_shared_asks_for_one_thread(observables):
    stage = "spectrum" if "spectrum" in observables else "spectrum_hessian"
    scene = scene_with({"n": [65536]} | observing(**observables), protocol=SLICED)
    job = stage_job(scene, TABLE, stage, Point(65536, 0.9, 1.0), samples=10**4)
    assert threads(job) == 1
    assert megabytes(job, TABLE, granted=8) == megabytes(job, TABLE)
    assert minutes(job, TABLE, granted=8) == minutes(job, TABLE)


def test_an_ensemble_is_gathered_point_by_point_and_read_whole():
    grid = {"n": [64], "phi": [0.85, 0.9], "kt": [1.0], "seeds": 10**4}
    scene = scene_with(grid | observing(spectrum="modes"))
    assert padded_megabytes(scene) == pytest.approx(2 * 10**4 * 3 * 64 * 8e-6)
    one, two = (gather_job(scene, TABLE, scene.points[:count], 100) for count in (1, 2))
    assert two.megabytes == one.megabytes
    assert two.seconds > one.seconds
    assert one.megabytes >= 3 * 64 * 10**4 * 3 * 8e-6
    assert reader_job(scene, TABLE).megabytes >= padded_megabytes(scene)
    few = scene_with(grid | {"seeds": 10} | observing(spectrum="modes"))
    assert megabytes(reader_job(few, TABLE), TABLE) < 600
    assert minutes(gather_job(few, TABLE, few.points, 2), TABLE) < 10


def test_a_workflow_of_many_jobs_starts_without_numpy():
    """The rules ask for the resources of every job before it starts."""
    code = "import sys, grainmodes.cost.resources; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
