"""`grainmodes cost`: the table it prints, and one sentence for every mistake."""

import re
from copy import deepcopy

import pytest
import yaml

from cost_fixtures import GRID, TABLE
from grainmodes.cli import main
from grainmodes.configuration import read_scene
from grainmodes.cost import COSTS, check_budget, estimate, read_table
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
    with pytest.raises(SystemExit):
        main(["cost", str(CONFIG / "default.yaml"), "--cores", "0"])
    assert "--cores: expected a whole number above 0, got '0'" in capsys.readouterr().err


MANY = """
grids:
  - {n: [10000000], phi: [0.9], kt: [1e-4], seeds: 1, observables: {spectrum: modes}}
"""
LONG = """
grids:
  - {n: [16], phi: [0.9], kt: [1e-4], seeds: 1, observables: {shear: true}}
protocol: {shear: {strain: 10.0, step: 1e-9, min_step: 1e-10, lowest_eigenvalue: states}}
"""
WIDE = """
grids:
  - n: [65536]
    phi: [0.90, 0.91, 0.92, 0.93, 0.94, 0.95, 0.96, 0.97, 0.98, 0.99]
    kt: [1e-4, 1.0]
    seeds: 10000
    observables: {spectrum: modes}
seeds_per_job: 1
"""


@pytest.mark.parametrize(
    ("scene", "sentence"),
    [
        (MANY, "grids[0]: expected jobs of at most 1000 CPU hours and 1000 GB, got "),
        (LONG, "grids[0]: expected jobs of at most 1000 CPU hours and 1000 GB, got "),
        (WIDE, "grids: expected a scene of at most 1e+06 CPU hours and 100 TB, got "),
    ],
)
def test_a_scene_has_a_budget(capsys, tmp_path, scene, sentence):
    path = tmp_path / "scene.yaml"
    path.write_text(f"study: large\n{scene}", encoding="utf-8")
    assert main(["cost", str(path)]) == 1
    said = capsys.readouterr()
    (line,) = said.err.splitlines()
    assert line.startswith(f"grainmodes cost: {sentence}") and said.out == ""


@pytest.mark.parametrize("path", sorted(CONFIG.glob("*.yaml")), ids=lambda path: path.stem)
def test_shipped_scenes_are_within_it(path):
    check_budget(read_scene(path), read_table())
