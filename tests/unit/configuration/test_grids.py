"""Points, blocks and observables, grid by grid."""

from grainmodes.configuration import scene_from
from grainmodes.parameters.grid import Point
from scenes import GRID, ONLY_G, WITH_RATTLERS, scene_of_grids, scene_with


def test_frictionless_scenes_have_no_stiffness():
    grid = {name: value for name, value in GRID.items() if name != "kt"}
    scene = scene_from({"study": "f", "grids": [grid], "effects": {"friction": False}})
    assert scene.grids[0].kt == (0.0,)
    assert not scene.law_at(0.0).frictional
    assert set(scene.figures) == {"g_phi", "g_nonaffine", "dos"}


def test_points_come_grid_by_grid():
    fields = {"spectrum": "none", "fields": True}
    scene = scene_of_grids({}, {"n": [128], "phi": [0.9], "observables": fields})
    assert len(scene.points) == len(set(scene.points)) == 10
    assert scene.points[:3] == [Point(16, 0.84, 1e-4), Point(16, 0.84, 1.0), Point(16, 0.9, 1e-4)]
    assert scene.points_of("fields") == [Point(128, 0.9, 1e-4), Point(128, 0.9, 1.0)]


def stages_with(**observables) -> list[str]:
    """Stages of a point of the small scene with these observables."""
    return scene_with("grid.observables", observables).responses(16, 0.9, 1.0)


def test_a_point_gets_what_its_grid_asks_for():
    assert stages_with() == ["rigidity", "step_strain", "spectrum"]
    assert stages_with(step_strain=False) == ["rigidity", "spectrum"]
    assert stages_with(rigidity=False, spectrum="counts") == ["step_strain", "spectrum"]
    assert stages_with(step_strain=False, spectrum="none", fields=True) == ["rigidity", "fields"]
    assert stages_with(rattlers=True, hessian=True, claim_diagnostics=True) == [
        *("rigidity", "step_strain", "spectrum"),
        *("spectrum_rattlers", "spectrum_hessian", "claim_diagnostics"),
    ]


def test_grids_have_their_own_observables_and_seeds():
    first = ONLY_G | {"seeds": 8}
    scene = scene_of_grids(first, WITH_RATTLERS | {"phi": [0.85], "kt": [1.0]}, seeds_per_job=4)
    assert scene.responses(16, 0.9, 1.0) == ["rigidity", "step_strain"]
    assert scene.responses(16, 0.85, 1.0)[2:] == ["spectrum", "spectrum_rattlers"]
    assert scene.blocks_of(16, 0.85, 1.0) == ["0000-0003"]
    assert scene.blocks_of(16, 0.9, 1.0) == ["0000-0003", "0004-0007"]
    assert scene.files_of("spectrum_rattlers") == [
        f"spectrum_rattlers/n~{n}/phi~0.85/kt~1.0/seeds~0000-0003.nc" for n in (16, 64)
    ]
    for off in [(32, 0.9, 1.0), (16, 0.85, 1e-4), (16, 0.873, 1.0)]:
        assert scene.responses(*off) == ["rigidity", "step_strain"]
        assert len(scene.blocks_of(*off)) == 2


def test_without_rotation_there_is_no_other_hessian():
    asked = {"hessian": True, "claim_diagnostics": True, "rattlers": True}
    scene = scene_of_grids({"kt": [0.0, 1.0], "observables": asked})
    assert scene.responses(16, 0.9, 0.0)[3:] == ["spectrum_rattlers"]
    assert scene.responses(16, 0.9, 1.0)[3:] == [
        "spectrum_rattlers",
        "spectrum_hessian",
        "claim_diagnostics",
    ]
