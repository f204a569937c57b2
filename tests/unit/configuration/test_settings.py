"""What a stage sees of a scene: the pieces it depends on, and nothing else."""

import json
from dataclasses import asdict

import pytest

from grainmodes.configuration import scene_of
from scenes import (
    GRID,
    scene_with,
)

SPECTRA = {"spectrum", "spectrum_rattlers", "spectrum_hessian"}
SHEARED = {"shear", "event_detail", "complex_pairs"}
STAGES = [
    *("compress", "rigidity", "step_strain", "fields", "claim_diagnostics", "release", "ensemble"),
    *sorted(SPECTRA | SHEARED),
]
DEPENDENCE = {
    "protocol.compression.phi_step": (5e-5, {"compress", "ensemble"}),
    "protocol.compression.large_diameter": (1.4, {"compress", "ensemble"}),
    "protocol.compression.masses": ("equal", {"compress", "ensemble"}),
    "protocol.rattlers.threshold": (
        1,
        {"rigidity", "fields", "claim_diagnostics", "ensemble"} | SPECTRA,
    ),
    "protocol.step_strain.strain": (
        1e-5,
        {"step_strain", "fields", "claim_diagnostics", "ensemble"},
    ),
    "protocol.shear.strain": (0.2, SHEARED | {"ensemble"}),
    "protocol.release.initial_velocity": (0.0, {"release", "ensemble"}),
    "protocol.complex_pairs.max_located": (2, {"complex_pairs", "ensemble"}),
    "protocol.spectrum.bin_density": (1.0, SPECTRA | {"ensemble"}),
    "contact_law.normal": ("harmonic", set(STAGES)),
    "grid.seeds": (8, set()),
    "grid.observables": ({"spectrum": "eigenvalues"}, set()),
    "seeds_per_job": (2, set()),
    "figures": (["g_phi"], set()),
}


@pytest.mark.parametrize("key", DEPENDENCE)
def test_a_stage_sees_only_what_it_depends_on(key):
    value, affected = DEPENDENCE[key]
    before, after = scene_with(), scene_with(key, value)
    changed = {stage for stage in STAGES if before.settings(stage) != after.settings(stage)}
    assert changed == affected


def test_the_kind_of_a_spectrum_is_a_setting_of_spectra_alone():
    scene = scene_with()
    changed = {s for s in STAGES if scene.settings(s, "modes") != scene.settings(s, "counts")}
    assert changed == {"spectrum", "spectrum_rattlers"}


@pytest.mark.parametrize("stage", STAGES)
def test_settings_are_a_piece_of_a_configuration(stage):
    settings = json.loads(scene_with("protocol.rattlers.threshold", 1).settings(stage))
    grid = GRID | {"observables": settings.pop("observables", {})}
    scene = scene_of({**settings, "study": "small", "grids": [grid]})
    parts = json.loads(json.dumps(asdict(scene.protocol)))
    for name, part in settings["protocol"].items():
        assert parts[name] == part
