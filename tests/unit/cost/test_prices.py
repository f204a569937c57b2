"""The cost of a scene: as many jobs as the workflow has, sums of laws, wall time and memory."""

from dataclasses import replace

import pytest

from cost_fixtures import FREE, TABLE, jobs, observing, scene_with, seconds_of_stage, total
from grainmodes.cost import estimate, wall_seconds
from grainmodes.parameters.compression import Compression


@pytest.mark.parametrize("stage", ["compress", "equilibrate", "rigidity"])
def test_costs_grow_as_the_table_says(stage):
    law = TABLE.laws[{"compress": "trajectory"}.get(stage, stage)]
    small, large = (seconds_of_stage(scene_with({"n": [n]}), stage) for n in (64, 1024))
    assert large / small == pytest.approx(16**law.exponent)


def test_costs_are_samples_times_the_law():
    assert seconds_of_stage(scene_with({"n": [1024]}), "rigidity") == pytest.approx(
        4 * 4 * TABLE.laws["rigidity"].seconds
    )
    assert seconds_of_stage(scene_with({"n": [1024], "seeds": 8}), "compress") == pytest.approx(
        8 * TABLE.laws["trajectory"].seconds
    )


def test_a_trajectory_ends_at_its_highest_fraction():
    law = TABLE.laws["trajectory"].seconds_at(64)
    assert seconds_of_stage(scene_with({"phi": [0.84, 0.83]}), "compress") == pytest.approx(
        4 * law * TABLE.climb[0.84]
    )
    halfway = (TABLE.climb[0.83] + TABLE.climb[0.84]) / 2
    assert TABLE.share(0.835) == pytest.approx(halfway)
    assert TABLE.share(0.91) > TABLE.share(0.9) == 1.0
    packed = seconds_of_stage(scene_with({"phi": [0.835]}), "equilibrate") / 4
    assert packed - TABLE.laws["equilibrate"].seconds_at(64) == pytest.approx(
        law * (halfway - TABLE.climb[0.83])
    )


@pytest.mark.parametrize(("kt", "factor"), [(0.5, 1.0), (1.0, 1.0), (4.0, 2.0), (9.0, 3.0)])
def test_springs_stiffer_than_the_normal_ones_take_shorter_steps(kt, factor):
    """As `protocols.compression.frictional_trajectory` chooses them."""
    grid = {"preparation": "frictional", "kt": [1.0]}
    at_one = seconds_of_stage(scene_with(grid), "compress_with_friction")
    found = seconds_of_stage(scene_with(grid | {"kt": [kt]}), "compress_with_friction")
    assert found == pytest.approx(factor * at_one)


def test_other_compressions_cost_more():
    assert TABLE.slowdown(Compression()) == 1.0
    assert TABLE.slowdown(Compression(phi_step=1e-3)) == pytest.approx(1 / 5.5, rel=0.01)
    assert TABLE.slowdown(Compression(relaxation="fire")) > 50
    assert TABLE.slowdown(Compression(), kt=4.0) == 1.0
    fire = {"compression": {"relaxation": "fire"}}
    assert seconds_of_stage(scene_with({}, protocol=fire), "compress") > 50 * seconds_of_stage(
        scene_with({}), "compress"
    )


def test_two_grids_cost_their_sum():
    one, other = {}, {"n": [128], "phi": [0.87]} | observing(spectrum="modes", fields=True)
    together = total(scene_with(one, other))
    assert together == pytest.approx(total(scene_with(one)) + total(scene_with(other)))
    assert together > 2 * total(scene_with(one))


def test_several_n_in_a_grid_cost_as_much_as_in_grids_of_their_own():
    asked = observing(spectrum="modes", fields=True)
    whole = scene_with({"n": [64, 128]} | asked)
    split = scene_with({"n": [64]} | asked, {"n": [128]} | asked)
    assert total(whole) == pytest.approx(total(split))
    assert jobs(whole) == jobs(split)


def test_grids_of_one_n_share_their_packings():
    whole = scene_with({"kt": [1e-4, 1e-2, 1.0]})
    split = scene_with({"kt": [1e-4]}, {"kt": [1e-2, 1.0]})
    assert total(split) == pytest.approx(total(whole))
    assert jobs(split) == jobs(whole)


def test_fields_are_those_of_one_sample():
    items = estimate(scene_with({"n": [1024]} | observing(fields=True)), FREE)
    (fields,) = [item for item in items if item.stage == "fields"]
    assert fields.samples == fields.jobs == 4
    assert fields.seconds == pytest.approx(4 * TABLE.laws["fields"].seconds)


def test_every_job_has_its_start_up():
    scene = scene_with({})
    dear = replace(TABLE, job=TABLE.job | {"seconds": 100.0})
    started = sum(item.seconds for item in estimate(scene, dear)) - total(scene)
    assert started == pytest.approx(100.0 * sum(jobs(scene).values()))


def test_jobs_are_those_of_the_workflow():
    grids = [
        {"phi": [0.8], "seeds": 4} | observing(step_strain=True),
        {"phi": [0.85], "kt": [1.0], "seeds": 2} | observing(spectrum="counts", hessian=True),
        {"phi": [0.85], "kt": [0.0], "seeds": 2} | observing(spectrum="modes", fields=True),
    ]
    scene = scene_with(*grids, seeds_per_job=2, figures=["dos"])
    assert jobs(scene) == {
        "compress": 7,
        "equilibrate": 3,
        "rigidity": 6,
        "step_strain": 4,
        "spectrum": 2,
        "spectrum_hessian": 1,
        "fields": 1,
        "gather": 4 + 2 + 1,
    }


def test_a_work_is_known_as_far_as_its_least_known_law():
    laws = {"count_superlu": 4096, "window_superlu": 1024}
    known = {name: replace(TABLE.laws[name], up_to=n) for name, n in laws.items()}
    table = replace(TABLE, laws=TABLE.laws | known)
    choices = {"spectrum": {"factorisation": "superlu"}}
    scene = scene_with({"n": [4096]} | observing(spectrum="binned_averages"), protocol=choices)
    (bands,) = [item for item in estimate(scene, table) if item.stage == "spectrum"]
    assert bands.up_to == 1024


def test_wall_time_is_shared_work_or_the_longest_chain():
    items = estimate(scene_with({}), TABLE)
    work_of_all = sum(item.seconds for item in items)
    assert wall_seconds(items, 1) == pytest.approx(work_of_all)
    chain = sum(item.chain for item in items)
    assert wall_seconds(items, 1000) == pytest.approx(chain)
    assert chain < work_of_all


def test_the_longest_chain_ends_in_the_longest_response():
    grids = [{"n": [64]}, {"n": [2048], "seeds": 1} | observing(step_strain=True)]
    items = estimate(scene_with(*grids, seeds_per_job=1), FREE)
    large = [item for item in items if item.n == 2048]
    chain = {item.stage: item.chain for item in large}
    assert wall_seconds(items, 1000) == pytest.approx(
        chain["compress"] + chain["equilibrate"] + max(chain["rigidity"], chain["step_strain"])
    )
    assert chain["rigidity"] != chain["step_strain"]


def test_memory_is_that_of_the_largest_work():
    scene = scene_with({"n": [1024]} | observing(spectrum="modes"))
    peaks = {item.stage: item.megabytes for item in estimate(scene, TABLE)}
    assert peaks["spectrum"] == TABLE.job["megabytes"] + TABLE.laws["dense_modes"].megabytes
