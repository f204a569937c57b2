"""What runs again: exactly what an addition or an edit touches."""

import pytest

from .conftest import SCENE, jobs_in

AFTER_POINTS = {"point": 4, "ensemble": 1, "checks": 1, "claims": 1, "figure": 2, "passed": 1}


def scene_with(**changes) -> dict:
    """The tiny scene with some keys of its grid changed."""
    return SCENE | {"grids": [SCENE["grids"][0] | changes]}


def test_a_second_run_has_nothing_to_do(study):
    before = study.fingerprints()
    assert "Nothing to be done" in study.run()
    assert study.fingerprints() == before


def test_every_result_is_there(built):
    files = set(built.fingerprints())
    assert {"ensemble.nc", "checks.txt", "figures/g_phi.png", "figures/dos.csv"} <= files
    assert "rigidity/n~16/phi~0.85/kt~0.0001/seeds~0000-0001.nc" in files
    assert not [name for name in files if "partial" in name]


def test_every_consistency_check_has_passed(built):
    lines = (built.results / "checks.txt").read_text().splitlines()
    assert len(lines) >= 10
    assert all(line.startswith(("passed", "stated")) for line in lines)
    assert "stated  not jammed: 4 of 8 converged samples" in lines
    assert "passed  no sample failed[spectrum]" in lines


def test_more_seeds_run_new_blocks_only(study):
    study.write_scene(scene_with(seeds=4))
    plan = study.run("-n")
    assert "seeds 0002-0003" in plan
    assert "seeds 0000-0001" not in plan
    new = {"compress": 6, "equilibrate": 2, "rigidity": 4, "step_strain": 4, "spectrum": 4}
    assert jobs_in(plan) == new | AFTER_POINTS


def test_another_stiffness_makes_no_packing(study):
    study.write_scene(scene_with(kt=[1e-4, 1.0, 10.0]))
    new = {"rigidity": 2, "step_strain": 2, "spectrum": 2}
    assert study.planned() == new | AFTER_POINTS | {"point": 2}


def test_another_fraction_starts_from_the_checkpoints(study):
    study.write_scene(scene_with(phi=[0.8, 0.843, 0.85]))
    new = {"equilibrate": 1, "rigidity": 2, "step_strain": 2, "spectrum": 2}
    assert study.planned() == new | AFTER_POINTS | {"point": 2}


def test_compression_with_friction_has_files_of_its_own(study):
    grid = SCENE["grids"][0] | {"n": [24], "preparation": "frictional"}
    scene = SCENE | {"grids": [SCENE["grids"][0], grid]}
    study.write_scene(scene)
    compressed = {"compress_with_friction": 12, "equilibrate_with_friction": 4}
    new = compressed | {"rigidity": 4, "step_strain": 4, "spectrum": 4}
    assert study.planned() == new | AFTER_POINTS
    file = "results/tiny/packings/n~24/phi~0.85/kt~1.0/seeds~0000-0001.nc"
    assert study.planned(file) == {"compress_with_friction": 6, "equilibrate_with_friction": 1}


@pytest.mark.parametrize(
    ("source", "rules"),
    [
        ("figures/paper_a/dos.py", {"figure": 1}),
        ("figures/grainmodes.mplstyle", {"figure": 2}),
        ("cli/show.py", {}),
        ("protocols/shear/step_strain.py", {"step_strain": 4} | AFTER_POINTS),
        ("spectrum/dense.py", {"spectrum": 4} | AFTER_POINTS),
        (
            "kernels/laws/elastic.py",
            {"compress": 6, "equilibrate": 2, "rigidity": 4, "step_strain": 4, "spectrum": 4}
            | AFTER_POINTS,
        ),
    ],
)
def test_an_edit_runs_what_depends_on_it(study, source, rules):
    study.edit(source)
    assert study.planned() == rules


def test_an_edited_figure_is_redrawn_alone(study):
    study.edit("figures/paper_a/dos.py")
    ensemble = study.results / "ensemble.nc"
    before = ensemble.stat().st_mtime_ns
    assert "Draw dos." in study.run()
    assert ensemble.stat().st_mtime_ns == before
    assert study.planned() == {}


def test_another_grid_leaves_the_first_alone(study):
    grid = SCENE["grids"][0] | {"phi": [0.853], "observables": {"spectrum": "none"}}
    study.write_scene(SCENE | {"grids": [*SCENE["grids"], grid]})
    new = {"equilibrate": 1, "rigidity": 2, "step_strain": 2}
    assert study.planned() == new | AFTER_POINTS | {"point": 2}


def test_another_kind_of_spectrum_runs_spectra_alone(study):
    study.write_scene(scene_with(observables={"spectrum": "eigenvalues"}))
    assert study.planned() == {"spectrum": 4} | AFTER_POINTS


def test_a_changed_setting_runs_its_stages(study):
    study.write_scene(SCENE | {"protocol": SCENE["protocol"] | {"rattlers": {"threshold": 1}}})
    assert study.planned() == {"rigidity": 4, "step_strain": 4, "spectrum": 4} | AFTER_POINTS
