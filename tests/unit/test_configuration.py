"""Scenes: defaults, one sentence per mistake, and what each stage sees of a scene."""

import json
from copy import deepcopy
from dataclasses import asdict
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from grainmodes.configuration import ConfigurationError, read_scene, scene_of
from grainmodes.configuration.grid_rules import AREA_PER_GRAIN
from grainmodes.configuration.grids import TOGETHER, lacking
from grainmodes.configuration.rules import NEEDED
from grainmodes.configuration.schema import complete, schema
from grainmodes.parameters.figures import FIGURES, Figure
from grainmodes.parameters.grid import Point
from grainmodes.parameters.protocol import Protocol

CONFIG = Path(__file__).parents[2] / "config"
GRID = {"n": [16, 64], "phi": [0.84, 0.9], "kt": [1e-4, 1.0], "seeds": 4}


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
    return scene_of(config)


def scene_of_grids(*changes: dict, **keys):
    """The scene of the small grid once for every dictionary of changes."""
    return scene_of({"study": "small", "grids": [GRID | change for change in changes], **keys})


def leaves(rule: dict, path: str = ""):
    for name, inner in rule["properties"].items():
        key = f"{path}.{name}".removeprefix(".")
        if "properties" in inner:
            yield from leaves(inner, key)
        elif "properties" in inner.get("items", {}):
            yield from leaves(inner["items"], key)
        else:
            yield key, inner


@pytest.mark.parametrize("path", sorted(CONFIG.glob("*.yaml")), ids=lambda path: path.stem)
def test_shipped_scenes_are_valid(path):
    assert read_scene(path).study == path.stem


def test_the_default_scene_is_paper_a_small():
    scene = read_scene(CONFIG / "default.yaml")
    small = [point for point in scene.points if point.n == 256]
    assert len(small) == 8 * 8
    assert {point.phi for point in small} == {0.83, 0.84, 0.85, 0.86, 0.87, 0.88, 0.89, 0.9}
    assert len(scene.blocks_of(256, 0.9, 1e-4)) == 1
    assert scene.figures == tuple(FIGURES)


def test_the_schema_is_one():
    Draft202012Validator.check_schema(schema())


@pytest.mark.parametrize(("key", "rule"), list(leaves(schema())), ids=lambda value: str(value)[:40])
def test_every_key_says_what_it_is(key, rule):
    assert rule["description"].endswith(".")
    inner = rule.get("items", rule)
    numeric = "number" in inner.get("type", "") or "integer" in inner.get("type", "")
    assert {"type", "enum"} & set(inner)
    assert not numeric or {"maximum"} <= set(inner)


@pytest.mark.parametrize("key", [key for key, _ in leaves(schema())])
def test_every_key_stands_in_the_handbook(key):
    assert f"`{key}`" in (CONFIG / "README.md").read_text(encoding="utf-8")


def test_defaults_are_those_of_the_protocol():
    assert scene_with().protocol == Protocol()


def test_completing_leaves_the_configuration_alone():
    config = {"study": "small", "grids": [deepcopy(GRID)], "contact_law": None}
    before = deepcopy(config)
    complete(config, schema())
    assert config == before


@pytest.mark.parametrize("text", ["1e-8", "1.0e-8", " 1E-08 "])
def test_yaml_numbers_without_a_point_are_numbers(text):
    assert scene_with("grid.kt", [text]).grids[0].kt == (1e-8,)


MISTAKES = [
    ("study", "a b", "study = 'a b': allowed is a name"),
    ("colour", 1, "unknown key 'colour', allowed are study, grids"),
    ("grid.phis", [1], "grids[0]: unknown key 'phis', allowed are n, phi, kt, seeds, observables"),
    ("grid.n", ..., "grids[0]: key 'n' is missing, needed is a list"),
    ("grid.n", [], "grids[0].n = []: allowed is a list, each item a whole even number"),
    ("grid.n", [15], "grids[0].n[0] = 15: allowed is a whole even number from 2"),
    ("grid.n", [0], "grids[0].n[0] = 0: allowed is a whole even number from 2"),
    ("grid.n", [64, 4], "grids[0].n = 4: at phi = 0.9 the box is 1.62 d wide"),
    ("grid.phi", [0.79], "grids[0].phi[0] = 0.79: allowed is a number from 0.8 to 1.2"),
    ("grid.phi", [float("nan")], "grids[0].phi[0] = 'nan': allowed is a number"),
    ("grid.phi", [float("inf")], "grids[0].phi[0] = inf: allowed is a number"),
    ("grid.phi", ["high"], "grids[0].phi[0] = 'high': allowed is a number"),
    ("grid.phi", [0.84, 0.9, "0.840"], "grids[0].phi: 0.84 stands there twice"),
    ("grid.kt", [-1], "grids[0].kt[0] = -1.0: allowed is a number from 0.0 to 1000.0 (k_N)"),
    ("grid.kt", [1, 1.0], "grids[0].kt: 1.0 stands there twice"),
    ("grid.kt", ..., "grids[0]: key 'kt' is missing"),
    ("grid.seeds", 0, "grids[0].seeds = 0: allowed is a whole number from 1"),
    ("grid.seeds", True, "grids[0].seeds = True: allowed is a whole number"),
    ("grid.seeds", 2.5, "grids[0].seeds = 2.5: allowed is a whole number"),
    ("grids", [], "grids = []: allowed is a list, each item a block of keys"),
    ("grids", {"n": [64]}, "allowed is a list, each item a block of keys"),
    ("grids", [1], "grids[0] = 1: allowed is a block of keys"),
    ("grid", GRID, "unknown key 'grid', allowed are study, grids"),
    ("grid.block", 2, "grids[0]: unknown key 'block', allowed are n"),
    ("block", 0, "block = 0: allowed is a whole number from 1"),
    ("effects.friction", "no", "effects.friction = 'no': allowed is true or false"),
    ("effects.friction", False, "grids[0].kt = [0.0001, 1.0]: effects.friction is false"),
    ("contact_law.normal", "linear", "'linear': allowed is one of hertz, harmonic"),
    ("contact_law.friction_coefficient", 0.5, "the tangential law 'elastic' has none"),
    ("contact_law.friction_coefficient", 0, "allowed is a number above 0.0 and up to 100.0"),
    ("contact_law.tangential", "sharp_coulomb", "friction_coefficient is missing"),
    (
        "grid.observables",
        {"spectrum": "all"},
        "grids[0].observables.spectrum = 'all': allowed is one of none, counts, bands, eigenvalues",
    ),
    ("grid.observables", {"g": 1}, "grids[0].observables: unknown key 'g', allowed are rigidity"),
    (
        "grid.observables",
        {"rattlers": True, "spectrum": "none"},
        "grids[0].observables.rattlers = True: observables.spectrum is none, "
        "allowed with rattlers are eigenvalues and modes",
    ),
    ("protocol.spectrum.method", "lanczos", "one of auto, dense, windows, counting"),
    ("protocol.spectrum.factorisation", "mumps", "one of auto, superlu, pardiso"),
    ("protocol.spectrum.fineness", 0, "allowed is a number above 0.0 and up to 1.0"),
    ("protocol.spectrum.modes_per_bin", 5, "allowed is a whole number from 6"),
    ("protocol.spectrum.substeps", 0, "allowed is a whole number from 1"),
    ("protocol.compression.phi_step", 3e-4, "allowed are steps that divide 0.01"),
    ("protocol.compression.initial_phi", 0.60005, "a whole number of steps of 0.0001"),
    ("protocol.compression.relaxation", "slow", "allowed is one of fast, fire"),
    ("protocol.rattlers.threshold", 3, "allowed is a whole number from 0 to 2"),
    ("figures", ["g_psi"], "unknown figure 'g_psi', allowed are g_phi"),
    ("figures", ["g_phi", "g_phi"], "figures: 'g_phi' stands there twice"),
]


@pytest.mark.parametrize(("path", "value", "sentence"), MISTAKES)
def test_a_mistake_is_one_sentence(path, value, sentence):
    with pytest.raises(ConfigurationError) as caught:
        scene_with(path, value)
    (line,) = str(caught.value).splitlines()
    assert sentence in line


def test_every_mistake_is_told_at_once():
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({"n": [3], "phi": [2]}, {"kt": [-1], "seeds": 0})
    assert len(str(caught.value).splitlines()) == 4


@pytest.mark.parametrize(
    "config", [{}, {"study": None, "grids": None}, {"study": 1, "grids": [{}]}]
)
def test_hardly_a_configuration(config):
    with pytest.raises(ConfigurationError):
        scene_of(config)


@pytest.mark.parametrize("text", ["", "- 1", "study: [", "\x00"])
def test_hardly_a_file(tmp_path, text):
    path = tmp_path / "scene.yaml"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=r"scene\.yaml: "):
        read_scene(path)


@given(st.integers(1, 40), st.floats(0.8, 1.2))
def test_a_box_holds_no_pair_twice(half, phi):
    wide_enough = (2 * half * AREA_PER_GRAIN / phi) ** 0.5 >= 2.0
    grid = {"n": [2 * half], "phi": [phi], "kt": [1.0], "seeds": 1}
    try:
        scene_of({"study": "box", "grids": [grid]})
    except ConfigurationError as error:
        assert not wide_enough
        assert "two images" in str(error)
    else:
        assert wide_enough


def test_frictionless_scenes_have_no_stiffness():
    grid = {name: value for name, value in GRID.items() if name != "kt"}
    scene = scene_of({"study": "f", "grids": [grid], "effects": {"friction": False}})
    assert scene.grids[0].kt == (0.0,)
    assert not scene.law_at(0.0).frictional
    assert set(scene.figures) == {"g_phi", "g_nonaffine", "dos"}


def test_a_point_lies_in_one_grid():
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({}, {"phi": [0.85]}, {"phi": [0.9, 0.91], "kt": [1.0, 2.0]})
    assert str(caught.value) == (
        "grids[2]: the point n = 16, phi = 0.9, kt = 1.0 also lies in grids[0], "
        "allowed is every point in one grid"
    )


def test_grids_of_one_n_share_their_files_of_seeds():
    apart = {"phi": [0.85], "n": [64, 128]}
    with pytest.raises(ConfigurationError) as caught:
        scene_of_grids({}, apart | {"seeds": 3}, block=2)
    assert str(caught.value) == (
        "grids[1].seeds = 3: grids[0] has 4 samples of n = 64 and both share files of 2 (block), "
        "allowed are equal numbers, or the smaller one a whole number of blocks"
    )
    assert scene_of_grids({}, apart | {"seeds": 2}, block=2)
    assert scene_of_grids({"seeds": 3}, apart | {"seeds": 2}, block=2)
    assert scene_of_grids({"seeds": 3}, apart | {"seeds": 3}, block=2)
    assert scene_of_grids({}, {"n": [128], "seeds": 3}, block=2)


def test_points_come_grid_by_grid():
    fields = {"spectrum": "none", "fields": True}
    scene = scene_of_grids({}, {"n": [128], "phi": [0.9], "observables": fields})
    assert len(scene.points) == len(set(scene.points)) == 10
    assert scene.points[:3] == [Point(16, 0.84, 1e-4), Point(16, 0.84, 1.0), Point(16, 0.9, 1e-4)]
    assert scene.field_points == [Point(128, 0.9, 1e-4), Point(128, 0.9, 1.0)]


def test_figures_follow_the_observables():
    nothing = {"spectrum": "none"}
    assert scene_with("grid.observables", nothing).figures == ("g_phi", "g_kt", "g_nonaffine")
    assert "participation" not in scene_with("grid.observables", {"spectrum": "counts"}).figures
    assert "participation" in scene_with("grid.observables", {"spectrum": "bands"}).figures
    config = {"study": "s", "grids": [GRID | {"observables": nothing}], "figures": ["dos"]}
    with pytest.raises(ConfigurationError, match=r"'dos' needs observables\.spectrum"):
        scene_of(config)


def test_every_need_of_a_figure_has_its_words():
    assert {need for figure in FIGURES.values() for need in figure.observables} <= set(NEEDED)


FRICTIONLESS = {"kt": [0.0]}
ONLY_SPECTRA = {"observables": {"rigidity": False, "spectrum": "counts"}}
ONLY_G = {"observables": {"spectrum": "none"}}
WITH_RATTLERS = {"observables": {"rattlers": True}}
WITH_HESSIAN = {"observables": {"hessian": True}, "n": [128]}


@pytest.mark.parametrize(
    ("needs", "grids", "missing"),
    [
        ("spectrum", [ONLY_G, ONLY_SPECTRA | FRICTIONLESS], []),
        ("spectrum friction", [ONLY_G, ONLY_SPECTRA | FRICTIONLESS], ["friction"]),
        ("spectrum frictionless", [ONLY_G | FRICTIONLESS, ONLY_SPECTRA], ["frictionless"]),
        ("spectrum friction frictionless", [ONLY_SPECTRA, ONLY_SPECTRA | FRICTIONLESS], []),
        ("modes friction", [ONLY_SPECTRA], ["modes"]),
        ("fields all_modes", [ONLY_G | {"n": [2048]}], ["fields"]),
        ("spectrum all_modes", [ONLY_SPECTRA | {"n": [2048]}], []),
        ("spectrum all_modes", [ONLY_SPECTRA | {"n": [4096]}], ["all_modes"]),
        ("spectrum several_n", [ONLY_SPECTRA], []),
        ("spectrum several_n", [ONLY_SPECTRA | {"n": [16]}], ["several_n"]),
        ("spectrum several_n", [ONLY_SPECTRA | {"n": [16]}, ONLY_SPECTRA | {"n": [64]}], []),
        ("spectrum several_n", [ONLY_SPECTRA | {"n": [16]}, ONLY_G | {"n": [64]}], ["several_n"]),
        ("rigidity several_phi", [ONLY_G | {"phi": [0.9]}], ["several_phi"]),
        ("rattlers friction", [WITH_RATTLERS], []),
        ("rattlers hessian", [WITH_RATTLERS, WITH_HESSIAN], ["rattlers", "hessian"]),
        ("fields", [WITH_RATTLERS], ["fields"]),
    ],
)
def test_observables_meet_in_one_grid_and_the_rest_in_those_that_have_them(
    monkeypatch, needs, grids, missing
):
    monkeypatch.setitem(FIGURES, "new", Figure("New", tuple(needs.split())))
    kept = [grid | {"phi": [0.8 + 0.02 * k, 0.9 + 0.02 * k]} for k, grid in enumerate(grids)]
    kept = kept if "several_phi" not in needs else grids
    assert lacking("new", scene_of_grids(*kept).grids) == missing
    assert set(missing) <= set(NEEDED)
    assert set(TOGETHER) <= set(NEEDED)


def stages_with(**observables) -> list[str]:
    """Stages of a point of the small scene with these observables."""
    return scene_with("grid.observables", observables).responses(16, 0.9, 1.0)


def test_a_point_gets_what_its_grid_asks_for():
    assert stages_with() == ["rigidity", "step_strain", "spectrum"]
    assert stages_with(step_strain=False) == ["rigidity", "spectrum"]
    assert stages_with(rigidity=False, spectrum="counts") == ["step_strain", "spectrum"]
    assert stages_with(step_strain=False, spectrum="none", fields=True) == ["rigidity"]
    assert stages_with(rattlers=True, hessian=True, probes=True) == [
        *("rigidity", "step_strain", "spectrum"),
        *("spectrum_rattlers", "spectrum_hessian", "probes"),
    ]


def test_grids_have_their_own_observables_and_seeds():
    first = ONLY_G | {"seeds": 8}
    scene = scene_of_grids(first, WITH_RATTLERS | {"phi": [0.85], "kt": [1.0]}, block=4)
    assert scene.responses(16, 0.9, 1.0) == ["rigidity", "step_strain"]
    assert scene.responses(16, 0.85, 1.0)[2:] == ["spectrum", "spectrum_rattlers"]
    assert scene.blocks_of(16, 0.85, 1.0) == ["0000-0003"]
    assert scene.blocks_of(16, 0.9, 1.0) == ["0000-0003", "0004-0007"]
    for off in [(32, 0.9, 1.0), (16, 0.85, 1e-4), (16, 0.873, 1.0)]:
        assert scene.responses(*off) == ["rigidity", "step_strain"]
        assert len(scene.blocks_of(*off)) == 2


def test_kinds_of_spectra_belong_to_grids():
    scene = scene_of_grids(ONLY_SPECTRA, ONLY_G | {"phi": [0.85]})
    assert scene.spectrum_kind(16, 0.9, 1.0) == "counts"
    assert scene.spectrum_kind(16, 0.85, 1.0) == "modes"


def test_without_rotation_there_is_no_other_hessian():
    asked = {"hessian": True, "probes": True, "rattlers": True}
    scene = scene_of_grids({"kt": [0.0, 1.0], "observables": asked})
    assert scene.responses(16, 0.9, 0.0)[3:] == ["spectrum_rattlers"]
    assert scene.responses(16, 0.9, 1.0)[3:] == ["spectrum_rattlers", "spectrum_hessian", "probes"]


SPECTRA = {"spectrum", "spectrum_rattlers", "spectrum_hessian"}
STAGES = ["compress", "rigidity", "step_strain", *sorted(SPECTRA), "fields", "probes", "ensemble"]
DEPENDENCE = {
    "protocol.compression.phi_step": (5e-5, {"compress", "ensemble"}),
    "protocol.rattlers.threshold": (
        1,
        {"rigidity", "fields", "probes", "ensemble"} | SPECTRA,
    ),
    "protocol.step_strain.strain": (1e-5, {"step_strain", "fields", "probes", "ensemble"}),
    "protocol.spectrum.fineness": (1.0, SPECTRA | {"ensemble"}),
    "contact_law.normal": ("harmonic", set(STAGES)),
    "grid.seeds": (8, set()),
    "grid.observables": ({"spectrum": "eigenvalues"}, set()),
    "block": (2, set()),
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
    parts = asdict(scene.protocol)
    for name, part in settings["protocol"].items():
        assert parts[name] == part
