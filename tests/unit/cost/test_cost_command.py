"""`grainmodes cost`: the table it prints, and one sentence for every mistake."""

import re
from copy import deepcopy

import pytest
import yaml

from cost_fixtures import GRID, TABLE
from grainmodes.cli import main
from grainmodes.configuration import read_scene
from grainmodes.cost import COSTS, estimate
from scenes import CONFIG


def said(capsys, *words: str) -> str:
    """What the command prints."""
    assert main(["cost", *words]) == 0
    return capsys.readouterr().out


def test_the_default_scene_is_priced(capsys):
    lines = said(capsys, str(CONFIG / "default.yaml")).splitlines()
    assert lines[0] == "default: 75 points on 8 grids"
    rows = [line.split() for line in lines if re.match(r"\w+ +(all|\d+) +\d+ ", line)]
    items = estimate(read_scene(CONFIG / "default.yaml"), TABLE)
    assert [(row[0], int(row[2]), int(row[4])) for row in rows] == [
        (item.stage, item.n, item.jobs) for item in items
    ]
    (last,) = [line.split() for line in lines if line.startswith("total")]
    assert int(last[1]) == sum(int(row[4]) for row in rows)
    assert float(last[2]) == pytest.approx(sum(item.seconds for item in items) / 3600, rel=0.01)
    assert float(last[2]) == pytest.approx(sum(float(row[5]) for row in rows), rel=0.02)
    assert any(re.fullmatch(r"wall time on 2 cores: [\d.]+ min", line) for line in lines)


def test_what_was_not_measured_is_marked(capsys, tmp_path):
    content = yaml.safe_load(COSTS.read_text())
    content["laws"]["rigidity"]["up_to"] = 128
    content["laws"]["claim_diagnostics"]["up_to"] = 0
    (tmp_path / "costs.yaml").write_text(yaml.safe_dump(content))
    text = said(capsys, str(CONFIG / "default.yaml"), "--costs", str(tmp_path / "costs.yaml"))
    marks = {line.split()[0]: line[-1] for line in text.splitlines() if line[-1:] in ("*", "?")}
    assert marks["rigidity"] == "*"
    assert marks["claim_diagnostics"] == "?"
    assert "step_strain" not in marks
    assert "* beyond the largest N that was measured" in text
    assert "? never measured: a guess" in text


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"colour": 1}, "unknown key 'colour', expected one of study, grids"),
        (
            {"grids": [GRID | {"n": [4]}]},
            "grids[0].n: expected at least 8 grains, because at phi = 0.9 ",
        ),
    ],
)
def test_a_mistaken_scene_is_one_sentence(capsys, tmp_path, change, sentence):
    path = tmp_path / "scene.yaml"
    path.write_text(yaml.safe_dump(deepcopy({"study": "s", "grids": [GRID]} | change)))
    assert main(["cost", str(path)]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("grainmodes cost: ")
    assert sentence in line


@pytest.mark.parametrize("text", ["", "laws: {", "laws: {rigidity: {speed: 1}}", "machine: x"])
def test_a_mistaken_table_is_one_sentence(capsys, tmp_path, text):
    (tmp_path / "costs.yaml").write_text(text)
    words = ["cost", str(CONFIG / "default.yaml"), "--costs", str(tmp_path / "costs.yaml")]
    assert main(words) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert "costs.yaml: expected a table of costs" in line


def test_a_table_without_laws_says_what_it_lacks(capsys, tmp_path):
    (tmp_path / "costs.yaml").write_text("machine: mine")
    words = ["cost", str(CONFIG / "default.yaml"), "--costs", str(tmp_path / "costs.yaml")]
    assert main(words) == 1
    assert "got a file without the key 'laws'" in capsys.readouterr().err


def test_there_is_a_core_at_least(capsys):
    assert main(["cost", str(CONFIG / "default.yaml"), "--cores", "0"]) == 1
    assert "--cores: expected a whole number from 1, got 0" in capsys.readouterr().err
