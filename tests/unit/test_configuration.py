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
from grainmodes.configuration.rules import AREA_PER_GRAIN
from grainmodes.configuration.schema import complete, schema
from grainmodes.parameters import FIGURES, Protocol

CONFIG = Path(__file__).parents[2] / "config"
GRID = {"n": [16, 64], "phi": [0.84, 0.9], "kt": [1e-4, 1.0], "seeds": 4}


def scene_with(path: str | None = None, value=None):
    """The scene of a small configuration with one key set; the value `...` removes the key."""
    config = {"study": "small", "grid": deepcopy(GRID)}
    if path is not None:
        *parents, last = path.split(".")
        room = config
        for name in parents:
            room = room.setdefault(name, {})
        room[last] = value
        if value is ...:
            del room[last]
    return scene_of(config)


def leaves(rule: dict, path: str = ""):
    for name, inner in rule["properties"].items():
        key = f"{path}.{name}".removeprefix(".")
        if "properties" in inner:
            yield from leaves(inner, key)
        else:
            yield key, inner


@pytest.mark.parametrize("path", sorted(CONFIG.glob("*.yaml")), ids=lambda path: path.stem)
def test_shipped_scenes_are_valid(path):
    assert read_scene(path).study == path.stem


def test_the_default_scene_is_paper_a_small():
    scene = read_scene(CONFIG / "default.yaml")
    assert (scene.n, scene.seeds, len(scene.phi)) == ((256,), 8, 8)
    of_ensembles = [name for name, figure in FIGURES.items() if figure.source == "ensemble"]
    assert scene.figures == tuple(of_ensembles)


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
    config = {"study": "small", "grid": deepcopy(GRID), "contact_law": None}
    before = deepcopy(config)
    complete(config, schema())
    assert config == before


@pytest.mark.parametrize("text", ["1e-8", "1.0e-8", " 1E-08 "])
def test_yaml_numbers_without_a_point_are_numbers(text):
    assert scene_with("grid.kt", [text]).kt == (1e-8,)


MISTAKES = [
    ("study", "a b", "study = 'a b': allowed is a name"),
    ("colour", 1, "unknown key 'colour', allowed are study, grid"),
    ("grid.phis", [1], "grid: unknown key 'phis', allowed are n, phi, kt, seeds, block"),
    ("grid.n", ..., "grid: key 'n' is missing, needed is a list"),
    ("grid.n", [], "grid.n = []: allowed is a list, each item a whole even number"),
    ("grid.n", [15], "grid.n[0] = 15: allowed is a whole even number from 2"),
    ("grid.n", [0], "grid.n[0] = 0: allowed is a whole even number from 2"),
    ("grid.n", [64, 4], "grid.n = 4: at phi = 0.9 the box is 1.62 d wide"),
    ("grid.phi", [0.79], "grid.phi[0] = 0.79: allowed is a number from 0.8 to 1.2"),
    ("grid.phi", [float("nan")], "grid.phi[0] = 'nan': allowed is a number"),
    ("grid.phi", [float("inf")], "grid.phi[0] = inf: allowed is a number"),
    ("grid.phi", ["high"], "grid.phi[0] = 'high': allowed is a number"),
    ("grid.phi", [0.84, 0.9, "0.840"], "grid.phi: 0.84 stands there twice"),
    ("grid.kt", [-1], "grid.kt[0] = -1.0: allowed is a number from 0.0 to 1000.0 (k_N)"),
    ("grid.kt", [1, 1.0], "grid.kt: 1.0 stands there twice"),
    ("grid.kt", ..., "grid: key 'kt' is missing"),
    ("grid.seeds", 0, "grid.seeds = 0: allowed is a whole number from 1"),
    ("grid.seeds", True, "grid.seeds = True: allowed is a whole number"),
    ("grid.seeds", 2.5, "grid.seeds = 2.5: allowed is a whole number"),
    ("grid", [1], "grid = [1]: allowed is a block of keys"),
    ("effects.friction", "no", "effects.friction = 'no': allowed is true or false"),
    ("effects.friction", False, "grid.kt = [0.0001, 1.0]: effects.friction is false"),
    ("contact_law.normal", "linear", "'linear': allowed is one of hertz, harmonic"),
    ("contact_law.friction_coefficient", 0.5, "the tangential law 'elastic' has none"),
    ("contact_law.friction_coefficient", 0, "allowed is a number above 0.0 and up to 100.0"),
    ("contact_law.tangential", "sharp_coulomb", "friction_coefficient is missing"),
    ("observables.spectrum", "all", "allowed is one of none, eigenvalues, modes"),
    ("observables.spectrum_phi", [0.85], "0.85 is not in grid.phi, allowed are [0.84, 0.9]"),
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
        scene_with("grid", {"n": [3], "phi": [2], "kt": [-1], "seeds": 0})
    assert len(str(caught.value).splitlines()) == 4


@pytest.mark.parametrize("config", [{}, {"study": None, "grid": None}, {"study": 1, "grid": {}}])
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
        scene_of({"study": "box", "grid": grid})
    except ConfigurationError as error:
        assert not wide_enough
        assert "two images" in str(error)
    else:
        assert wide_enough


def test_frictionless_scenes_have_no_stiffness():
    grid = {name: value for name, value in GRID.items() if name != "kt"}
    scene = scene_of({"study": "f", "grid": grid, "effects": {"friction": False}})
    assert scene.kt == (0.0,)
    assert not scene.law_at(0.0).frictional
    assert set(scene.figures) == {"g_phi", "g_nonaffine", "dos"}


def test_figures_follow_the_observables():
    assert scene_with("observables.spectrum", "none").figures == ("g_phi", "g_kt", "g_nonaffine")
    assert "participation" not in scene_with("observables.spectrum", "eigenvalues").figures
    config = {"study": "s", "grid": GRID, "observables": {"spectrum": "none"}, "figures": ["dos"]}
    with pytest.raises(ConfigurationError, match=r"'dos' needs observables\.spectrum"):
        scene_of(config)


def test_a_point_gets_what_is_asked_for():
    scene = scene_with("observables.spectrum_phi", [0.9])
    assert scene.responses(0.9) == ["rigidity", "step_strain", "spectrum"]
    assert scene.responses(0.84) == ["rigidity", "step_strain"]
    assert scene.responses(0.873) == ["rigidity", "step_strain", "spectrum"]
    assert scene_with("observables", {"rigidity": True, "step_strain": False}).responses(0.9) == [
        "rigidity",
        "spectrum",
    ]
    only_g = {"rigidity": True, "step_strain": False, "spectrum": "none"}
    assert scene_with("observables", only_g).responses(0.9) == ["rigidity"]


DEPENDENCE = {
    "protocol.compression.phi_step": (5e-5, {"compress", "ensemble"}),
    "protocol.rattlers.keep": (True, {"rigidity", "spectrum", "ensemble"}),
    "protocol.step_strain.strain": (1e-5, {"step_strain", "ensemble"}),
    "observables.spectrum": ("eigenvalues", {"spectrum"}),
    "contact_law.normal": (
        "harmonic",
        {"compress", "rigidity", "step_strain", "spectrum", "ensemble"},
    ),
    "grid.seeds": (8, set()),
    "grid.block": (2, set()),
    "figures": (["g_phi"], set()),
}
STAGES = ["compress", "rigidity", "step_strain", "spectrum", "ensemble"]


@pytest.mark.parametrize("key", DEPENDENCE)
def test_a_stage_sees_only_what_it_depends_on(key):
    value, affected = DEPENDENCE[key]
    before, after = scene_with(), scene_with(key, value)
    changed = {stage for stage in STAGES if before.settings(stage) != after.settings(stage)}
    assert changed == affected


@pytest.mark.parametrize("stage", STAGES)
def test_settings_are_a_piece_of_a_configuration(stage):
    settings = json.loads(scene_with("protocol.rattlers.keep", True).settings(stage))
    scene = scene_of({**settings, "study": "small", "grid": GRID})
    parts = asdict(scene.protocol)
    for name, part in settings["protocol"].items():
        assert parts[name] == part
