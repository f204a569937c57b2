"""What a stage sees of a scene: the pieces it depends on, and nothing else."""

import json
from dataclasses import asdict

import pytest

from grainmodes.configuration import stage_settings
from grainmodes.parameters.stages import STAGES as TABLE
from scenes import scene_of_grids, scene_with

SPECTRA = {"spectrum", "spectrum_rattlers", "spectrum_hessian"}
SHEARED = {"shear", "event_detail", "complex_pairs"}
FRICTIONAL = {"compress_with_friction", "equilibrate_with_friction"}
COMPRESSED = {"compress", "equilibrate", "ensemble"} | FRICTIONAL
STAGES = (
    *("compress", "equilibrate", "rigidity", "step_strain", "fields", "claim_diagnostics"),
    *("shear", "event_detail", "complex_pairs", "release", "law_comparison", "ensemble"),
    *sorted(SPECTRA),
    *sorted(FRICTIONAL),
)
DEPENDENCE = {
    "protocol.compression.phi_step": (5e-5, COMPRESSED),
    "protocol.compression.large_diameter": (1.4, COMPRESSED),
    "protocol.compression.masses": ("equal", COMPRESSED),
    "protocol.frictional_compression.drag": (2.0, FRICTIONAL | {"ensemble"}),
    "contact_law.tangential": ("elastic_force", set(STAGES) - {"compress", "equilibrate"}),
    "protocol.rattlers.threshold": (
        1,
        {
            "rigidity",
            "step_strain",
            "fields",
            "claim_diagnostics",
            "spectrum",
            "spectrum_hessian",
            "ensemble",
        },
    ),
    "protocol.step_strain.strain": (
        1e-5,
        {"step_strain", "fields", "claim_diagnostics", "ensemble"},
    ),
    "protocol.shear.strain": (0.2, SHEARED | {"law_comparison", "ensemble"}),
    "protocol.release.initial_velocity": (0.0, {"release", "ensemble"}),
    "protocol.complex_pairs.max_located": (2, {"complex_pairs", "ensemble"}),
    "protocol.spectrum.bin_density": (1.0, SPECTRA | {"ensemble"}),
    "contact_law.normal": ("harmonic", set(STAGES)),
    "grid.seeds": (8, set()),
    "grid.observables": ({"spectrum": "eigenvalues"}, {"spectrum", "spectrum_rattlers"}),
    "seeds_per_job": (2, set()),
    "figures": (["g_phi"], set()),
}


def settings(scene, stage: str) -> str:
    return scene.summary() if stage == "ensemble" else scene.settings(stage)


@pytest.mark.parametrize("key", DEPENDENCE)
def test_a_stage_sees_only_what_it_depends_on(key):
    value, affected = DEPENDENCE[key]
    before, after = scene_with(), scene_with(key, value)
    changed = {stage for stage in STAGES if settings(before, stage) != settings(after, stage)}
    assert changed == affected


def test_observables_are_those_of_the_grid_of_the_point():
    first = {"observables": {"spectrum": "counts", "shear": True, "coarse_run": True}}
    scene = scene_of_grids(first, {"phi": [0.85], "observables": {"spectrum": "none"}})
    kinds = {phi: json.loads(scene.settings("spectrum", (16, phi, 1.0))) for phi in (0.9, 0.85)}
    assert kinds[0.9]["observables"] == {"spectrum": "counts"}
    assert kinds[0.85]["observables"] == {"spectrum": "modes"}  # requested by its path alone
    coarse = [json.loads(scene.settings("shear", (16, phi, 1.0))) for phi in (0.9, 0.85)]
    assert [part["observables"] for part in coarse] == [{"coarse_run": True}, {"coarse_run": False}]


@pytest.mark.parametrize("stage", TABLE)
def test_a_command_reads_the_settings_that_its_rule_writes(stage):
    scene = scene_with("protocol.rattlers.threshold", 1)
    given = json.loads(scene.settings(stage))
    read = stage_settings(given, kt=1.0)
    parts = json.loads(json.dumps(asdict(read.protocol)))
    for name, part in given["protocol"].items():
        assert parts[name] == part
    assert read.law.normal == scene.law.normal
    assert all(
        read.observables[name] == value for name, value in given.get("observables", {}).items()
    )
