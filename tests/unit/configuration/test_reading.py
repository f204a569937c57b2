"""What a scene file says is what its text shows: YAML 1.2, and one sentence for what is none."""

import math
from itertools import pairwise

import pytest

from grainmodes.configuration import ConfigurationError, read_config, read_scene, scalar

SCENE = """\
study: {study}
grids:
  - {{n: [{n}], phi: [{phi}], kt: [{kt}], seeds: {seeds}, observables: {{spectrum: counts}}}}
protocol: {{spectrum: {{bin_density: {density}}}}}
"""
USUAL = {"study": "s", "n": "16", "phi": "0.9", "kt": "1e-4", "seeds": "2", "density": "1"}


def scene_of(tmp_path, **texts):
    path = tmp_path / "scene.yaml"
    path.write_text(SCENE.format(**USUAL | texts), encoding="utf-8")
    return read_scene(path)


def config_of(tmp_path, text: str):
    path = tmp_path / "scene.yaml"
    path.write_text(text, encoding="utf-8")
    return read_config(path)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-8", 1e-8),  # YAML 1.1: a text
        ("0100", 100),  # 64
        ("0o17", 15),
        ("0x1F", 31),
        ("1:30", "1:30"),  # 90
        ("1_000", "1_000"),  # 1000
        ("2024-01-01", "2024-01-01"),  # a date
        ("yes", "yes"),  # true
        ("off", "off"),  # false
        ("True", True),
        ("~", None),
        (".5", 0.5),
        ("1.", 1.0),
        ("-.INF", -math.inf),
        ("+.5e+3", 500.0),
        ("=", "="),
        ("'1e-8'", "1e-8"),
        ('"true"', "true"),
        ("!!str 5", "5"),
    ],
)
def test_a_value_is_what_its_text_shows(tmp_path, text, value):
    (found,) = config_of(tmp_path, f"key: {text}").values()
    assert found == value and type(found) is type(value)
    if text[0] not in "'!\"":
        assert scalar(text) == value


def test_numbers_of_a_scene(tmp_path):
    assert scene_of(tmp_path).grids[0].kt == (1e-4,)
    assert scene_of(tmp_path, n="0100").grids[0].n == (100,)
    assert str(scene_of(tmp_path, kt="-0.0").grids[0].kt) == "(0.0,)"


@pytest.mark.parametrize(
    ("key", "text", "sentence"),
    [
        ("seeds", "1:30", "grids[0].seeds: expected a whole number from 1 to 10000, got '1:30'"),
        ("seeds", "1_0", "grids[0].seeds: expected a whole number from 1 to 10000, got '1_0'"),
        (
            "density",
            "'1e-1'",
            "protocol.spectrum.bin_density: expected a number from 0.01 to 1.0, got '1e-1'",
        ),
        ("study", "1e3", "study: expected a name"),
        ("study", '"t\\n"', "study: expected a name"),
    ],
)
def test_what_a_scene_does_not_take(tmp_path, key, text, sentence):
    with pytest.raises(ConfigurationError) as caught:
        scene_of(tmp_path, **{key: text})
    assert str(caught.value).startswith(sentence)
    assert len(str(caught.value).splitlines()) == 1


LAUGHS = "\n".join(f"{b}: &{b} [{', '.join([f'*{a}'] * 10)}]" for a, b in pairwise("abcdefg"))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a: 1\nb: 2\na: 3", ", line 3: expected every key of a block once, got 'a' twice"),
        ("a: {b: 1, b: 2}", ", line 1: expected every key of a block once, got 'b' twice"),
        ("- {b: 1, b: 2}", ", line 1: expected every key of a block once, got 'b' twice"),
        ('{"a": 1, "a": 1}', ", line 1: expected every key of a block once, got 'a' twice"),
        ("1: 2", ", line 1: expected a text as key, got 1"),
        ("[a]: 2", ", line 1: expected a text as key, got ['a']"),
        ("- 1", ": expected the keys study and grids, got no keys"),
        ("", ": expected the keys study and grids, got no keys"),
        ("a: [", ", line 1: while parsing a flow node expected the node content"),
        ("a: 1\n\tb: 2", ", line 2: while scanning for the next token found character"),
        ("a: 1\n---\nb: 2", ", line 2: expected a single document in the stream but found another"),
        ("\x00", ": expected YAML in UTF-8, got unacceptable character"),
        ("a: !!python/object:os.system x", ", line 1: could not determine a constructor"),
        ("a: !!timestamp 2024-01-01", ", line 1: could not determine a constructor"),
        ("a: !!int x", ", line 1: expected a value of the type int, got 'x'"),
        (f"a: {'9' * 5000}", ", line 1: expected a value of the type int, got '999"),
        ("a: &a [*a]", ": expected at most 100000 values in blocks at most 20 deep"),
        (f"a: {'[' * 5000}", ": expected at most 100000 values in blocks at most 20 deep"),
        (f"a: &a [1, 2]\n{LAUGHS}", ": expected at most 100000 values in blocks at most 20 deep"),
        ("#" * 200_001, ": expected a scene of at most 200000 bytes, got a longer file"),
    ],
)
def test_what_no_scene_may_be(tmp_path, text, sentence):
    with pytest.raises(ConfigurationError) as caught:
        config_of(tmp_path, text)
    (line,) = str(caught.value).splitlines()
    assert line.startswith(f"{tmp_path / 'scene.yaml'}{sentence}")


def test_aliases_stand_for_their_block_and_merge_keys_for_nothing(tmp_path):
    assert config_of(tmp_path, "a: &a {b: 1}\nc: *a") == {"a": {"b": 1}, "c": {"b": 1}}
    assert config_of(tmp_path, "a: &a {b: 1}\nc: {<<: *a}")["c"] == {"<<": {"b": 1}}
    with pytest.raises(ConfigurationError, match=r"protocol.spectrum: unknown key '<<', expected"):
        scene_of(tmp_path, density="1, <<: {method: dense}")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [("nowhere.yaml", "no such file or directory"), (".", "is a directory")],
)
def test_what_is_no_file(tmp_path, name, sentence):
    with pytest.raises(ConfigurationError) as caught:
        read_config(tmp_path / name)
    assert str(caught.value) == f"{tmp_path / name}: {sentence}"


def test_what_is_no_utf8(tmp_path):
    (tmp_path / "scene.yaml").write_bytes(b"study: \xff")
    with pytest.raises(ConfigurationError, match=r"scene\.yaml: expected YAML in UTF-8, got 'utf"):
        read_config(tmp_path / "scene.yaml")
