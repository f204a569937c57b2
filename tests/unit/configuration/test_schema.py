"""The schema: shipped scenes, defaults, and keys that say what they are."""

import re
from copy import deepcopy

import pytest
from jsonschema import Draft202012Validator

from grainmodes.configuration import read_scene
from grainmodes.configuration.schema import complete, schema
from grainmodes.parameters.complex_pairs import DETECTIONS
from grainmodes.parameters.compression import RELAXATIONS
from grainmodes.parameters.factors import FACTORISATIONS
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.law import NORMAL_LAWS, TANGENTIAL_LAWS
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.release import DAMPED_MOTIONS
from grainmodes.parameters.spectra import SPECTRA, SPECTRUM_METHODS
from grainmodes.parameters.strain import LOWEST_EIGENVALUES, STRAIN_RELAXATIONS
from scenes import CONFIG, GRID, scene_with


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


def test_the_handbook_lists_every_scene():
    handbook = (CONFIG / "README.md").read_text(encoding="utf-8")
    table = handbook.partition("| file |")[2].partition("\n\n")[0]
    listed = re.findall(r"^\| `(\S+\.yaml)` \| \S", table, re.MULTILINE)
    assert sorted(listed) == sorted(path.name for path in CONFIG.glob("*.yaml"))


def test_the_default_scene_is_paper_a_small():
    scene = read_scene(CONFIG / "default.yaml")
    small = [point for point in scene.points if point.n == 256]
    assert len(small) == 8 * 8 + 7
    assert {point.phi for point in small} == {0.83, 0.84, 0.85, 0.86, 0.87, 0.88, 0.89, 0.9}
    assert len(scene.blocks_of(256, 0.9, 1e-4)) == 1
    of_a = [name for name, figure in FIGURES.items() if "paper A" in figure.title]
    assert scene.figures == (*of_a, "nonaffine_crossing", "rigidity_exponent")


def test_the_schema_is_one():
    Draft202012Validator.check_schema(schema())


def test_every_key_says_what_it_is():
    for key, rule in leaves(schema()):
        inner = rule.get("items", rule)
        numeric = "number" in inner.get("type", "") or "integer" in inner.get("type", "")
        assert rule["description"].endswith("."), key
        assert {"type", "enum"} & set(inner), key
        assert not numeric or {"maximum"} <= set(inner), key


def test_every_key_stands_in_the_handbook():
    handbook = (CONFIG / "README.md").read_text(encoding="utf-8")
    keys = [key for key, _ in leaves(schema())]
    assert len(keys) > 60 and [key for key in keys if f"`{key}`" not in handbook] == []


def test_defaults_are_those_of_the_protocol():
    assert scene_with().protocol == Protocol()


CHOICES = {
    DAMPED_MOTIONS,
    DETECTIONS,
    FACTORISATIONS,
    LOWEST_EIGENVALUES,
    NORMAL_LAWS,
    RELAXATIONS,
    SPECTRA,
    SPECTRUM_METHODS,
    STRAIN_RELAXATIONS,
    TANGENTIAL_LAWS,
}


@pytest.mark.parametrize("names", sorted(CHOICES))
def test_choices_by_name_are_those_of_the_code(names):
    assert names in {tuple(rule["enum"]) for _, rule in leaves(schema()) if "enum" in rule}


def test_completing_leaves_the_configuration_alone():
    config = {"study": "small", "grids": [deepcopy(GRID)], "contact_law": None}
    before = deepcopy(config)
    complete(config, schema())
    assert config == before
