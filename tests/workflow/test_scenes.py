"""What a scene asks for is what runs; a mistaken scene runs nothing."""

import re

import pytest

from grainmodes.dataset.files import read_block

from .conftest import SCENE, jobs_in

PACKINGS = {"compress": 6, "equilibrate": 2}
END = {"ensemble": 1, "checks": 1, "claims": 1}


def scene_with_observables(observables: dict, **changes) -> dict:
    """The tiny scene with these observables, and every figure that they allow."""
    scene = {key: value for key, value in SCENE.items() if key != "figures"}
    return scene | {"grids": [SCENE["grids"][0] | {"observables": observables}]} | changes


def test_every_observable(fresh):
    asked = ["rattlers", "hessian", "fields", "claim_diagnostics", "event_detail", "complex_pairs"]
    fresh.write_scene(
        scene_with_observables(dict.fromkeys(asked, True) | {"spectrum": "eigenvalues"})
    )
    plan = fresh.run("-n", "-p")
    jobs = jobs_in(plan)
    for stage in (
        "spectrum",
        "spectrum_rattlers",
        "spectrum_hessian",
        "claim_diagnostics",
        "fields",
        "event_detail",
        "complex_pairs",
    ):
        assert jobs[stage] == 4
    assert "grainmodes spectrum-rattlers" in plan
    assert "grainmodes spectrum-hessian" in plan
    (gather,) = re.findall(r"grainmodes gather .*phi~0.85/kt~1.0.nc", plan)
    assert "spectrum_hessian/" in gather
    for single in ("fields", "event_detail"):
        assert f" results/tiny/{single}/n~16/phi~0.85/kt~1.0.nc" in gather, "why it failed, if so"


def test_grids_get_what_they_ask_for(fresh):
    grid = SCENE["grids"][0]
    grids = [
        grid | {"phi": [0.8], "seeds": 4, "observables": {"spectrum": "none"}},
        grid | {"phi": [0.85], "kt": [1.0], "observables": {"spectrum": "counts"}},
        grid | {"phi": [0.85], "kt": [1e-4], "observables": {"rigidity": False}},
    ]
    fresh.write_scene(scene_with_observables({}, grids=grids))
    plan = fresh.run("-n", "-p")
    jobs = jobs_in(plan)
    assert {rule: jobs[rule] for rule in ("equilibrate", "rigidity", "spectrum", "point")} == {
        "equilibrate": 3,
        "rigidity": 5,
        "spectrum": 2,
        "point": 4,
    }
    assert plan.count('"spectrum": "counts"') == plan.count('"spectrum": "modes"') == 1
    assert jobs["compress"] == 7


def test_the_default_scene_does_not_leak(fresh):
    default = fresh.folder / "config" / "default.yaml"
    default.write_text(default.read_text() + "seeds_per_job: 1\n")
    fresh.write_scene({key: value for key, value in SCENE.items() if key != "seeds_per_job"})
    assert fresh.planned()["rigidity"] == 4


def test_one_point_off_the_grid(study):
    target = "results/tiny/rigidity/n~16/phi~0.853/kt~3e-05/seeds~0001-0001.nc"
    assert study.planned(target) == {"compress": 6, "equilibrate": 1, "rigidity": 1}
    inside = target.replace("0001-0001", "0000-0001")
    assert study.planned(inside) == {"equilibrate": 1, "rigidity": 1}
    study.run(inside)
    block = read_block(study.folder / inside)
    assert float(block.attributes["phi"]) == 0.853
    assert float(block.attributes["kt"]) == 3e-05
    assert block.variables["seed"].tolist() == [0, 1]


def test_a_fraction_out_of_range_is_refused_by_its_job(fresh):
    target = "results/tiny/trajectories/n~16/phi~0.5/seeds~0000-0000.nc"
    said = fresh.run(target, succeeds=False)
    assert "--phi: expected a number from 0.8 to 1.2" in said


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"colour": 1}, "unknown key 'colour', expected one of study, grids"),
        ({"grids": [SCENE["grids"][0] | {"n": [4]}]}, "can touch two images of another"),
        ({"grids": SCENE["grids"] * 2}, "also lies in grids[0]"),
    ],
)
def test_a_mistaken_scene_is_refused(fresh, change, sentence):
    fresh.write_scene(SCENE | change)
    said = fresh.run("-n", succeeds=False)
    assert sentence in said
    assert "Traceback" not in said
    assert not fresh.results.exists()


def test_a_scene_that_is_missing(fresh):
    (fresh.folder / "config" / "tiny.yaml").unlink()
    assert "tiny.yaml" in fresh.run("-n", succeeds=False)
