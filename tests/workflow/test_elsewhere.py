"""The workflow started from other folders, and as a module of another workflow.

Results lie in the working directory, the sources and the default scene in the checkout.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from .conftest import INSTALLED, SCENE, Study, jobs_in

GRID = {"n": [16], "phi": [0.8], "kt": [1e-4], "seeds": 2, "observables": {"spectrum": "none"}}
SHORT = SCENE | {"grids": [GRID], "figures": ["g_phi"]}
"""The smallest study that ends with a figure."""

MODULE = """
configfile: "whole.yaml"

module grains:
    snakefile: "{checkout}/Snakefile"
    config: config["grains"]

use rule * from grains as grains_*
"""

TWISTS = {
    "study: twice\ngrids: []\nseeds_per_job: 2\nseeds_per_job: 1": (
        "line 4: expected every key of a block once, got 'seeds_per_job' twice"
    ),
    "study: colon\ngrids: [{n: [16], phi: [0.9], kt: [1e-4], seeds: 1:30}]": (
        "grids[0].seeds: expected a whole number from 1 to 10000, got '1:30'"
    ),
    "study: text\ngrids: [{n: [16], phi: [0.9], kt: ['1e-4'], seeds: 1}]": (
        "grids[0].kt[0]: expected a number from 0.0 to 1000.0 (k_N), got '1e-4'"
    ),
    'study: "t\\n"\ngrids: [{n: [16], phi: [0.9], kt: [1e-4], seeds: 1}]': (
        "study: expected a name of at most 100 letters"
    ),
    "study: large\ngrids: [{n: [10000000], phi: [0.9], kt: [1e-4], seeds: 1}]": (
        "grids[0]: expected jobs of at most 1000 CPU hours and 1000 GB, got "
    ),
}
"""Scenes that YAML 1.1 twists, or that no machine computes → what is said."""


def snakemake(folder: Path, *words: str) -> subprocess.Popen:
    """Snakemake in a folder, in the background."""
    return subprocess.Popen(
        [*INSTALLED, "-j1", *words],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def said(run: subprocess.Popen, succeeds: bool = True) -> str:
    """What a run says, once it has ended."""
    text = run.communicate(timeout=900)[0]
    assert (run.returncode == 0) == succeeds, text
    assert "Traceback" not in text
    return text


@pytest.fixture(scope="module")
def folders(checkout, tmp_path_factory) -> dict[str, Path]:
    """The short study in three folders with a space in their names, run at once."""
    root = tmp_path_factory.mktemp("else where")
    folders = {name: root / name for name in ("source", "directory", "module")}
    for folder in folders.values():
        folder.mkdir()
    (root / "scene.yaml").write_text(yaml.safe_dump(SHORT), encoding="utf-8")
    (folders["module"] / "Snakefile").write_text(MODULE.format(checkout=checkout), encoding="utf-8")
    whole = yaml.safe_dump({"other": "key", "grains": SHORT})
    (folders["module"] / "whole.yaml").write_text(whole, encoding="utf-8")
    options = {
        "source": ["-s", str(checkout / "Snakefile"), "--configfile", "../scene.yaml"],
        "directory": [
            *("-s", str(checkout / "Snakefile"), "--configfile", str(root / "scene.yaml")),
            *("--directory", str(folders["directory"])),
        ],
        "module": [],
    }
    where = folders | {"directory": root}
    runs = [snakemake(where[name], *words) for name, words in options.items()]
    for run in runs:
        said(run)
    return folders


def test_a_study_elsewhere_has_the_same_bytes(folders):
    made = []
    for folder in folders.values():
        study = Study(folder)
        made.append(study.fingerprints())
        checks = (study.results / "checks.txt").read_text(encoding="utf-8")
        assert "\nfailed" not in checks and "passed  forces balance" in checks
    assert made[0] == made[1] == made[2]
    assert {"ensemble.nc", "claims.md", "figures/g_phi.png", "checks.passed"} <= set(made[0])


def test_nothing_lies_in_the_checkout(folders, checkout):
    assert not (checkout / "results").exists() and not (checkout / ".snakemake").exists()


@pytest.mark.parametrize("target", ["accuracy", "benchmarks"])
def test_measurements_are_found_from_another_folder(checkout, tmp_path, target):
    plan = said(snakemake(tmp_path, "-n", "-s", str(checkout / "Snakefile"), target))
    assert jobs_in(plan)[target] == 1
    assert "default.yaml" not in os.listdir(tmp_path)
    script = "import measurements; print(measurements.__file__)"
    module = f'include: "{checkout}/workflow/rules/scene.smk"\nimport subprocess, sys\n'
    module += f"print(subprocess.check_output([sys.executable, '-c', {script!r}], text=True))\n"
    (tmp_path / "Snakefile").write_text(f"{module}rule nothing:\n    shell: 'true'\n")
    assert f"{checkout}/measurements/__init__.py" in said(snakemake(tmp_path, "-n"))


def test_every_rule_can_be_used_under_its_own_name(checkout, tmp_path):
    snakefile = f'module grains:\n    snakefile: "{checkout}/Snakefile"\n    config: config\n'
    (tmp_path / "Snakefile").write_text(f"{snakefile}    prefix: 'deep'\nuse rule * from grains\n")
    scene = str(checkout / "config" / "tiny.yaml")
    plan = said(snakemake(tmp_path, "-n", "-p", "--configfile", scene))
    assert jobs_in(plan)["figure"] == 2
    assert "-o deep/results/tiny/figures/dos " in plan
    assert " results/" not in plan, "every path has the prefix"


@pytest.mark.parametrize("text", TWISTS)
def test_every_way_in_says_the_same_of_a_scene(fresh, text):
    """`snakemake -n`, `make study` and `grainmodes cost`; nothing is left."""
    scene = fresh.folder / "config" / "tiny.yaml"
    scene.write_text(text, encoding="utf-8")
    study = [sys.executable, "workflow/scripts/study.py", "-j2", "--configfile", "config/tiny.yaml"]
    cost = [sys.executable, "-m", "grainmodes", "cost", "config/tiny.yaml"]
    for command in (fresh.command("-n"), study, cost):
        run = subprocess.run(
            command, cwd=fresh.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        assert run.returncode not in (0, 2), run.stdout
        assert TWISTS[text] in run.stdout and "Traceback" not in run.stdout
    assert not fresh.results.exists()


def test_a_broken_file_is_named_by_make_study(fresh):
    """Snakemake alone says neither its name nor the line."""
    (fresh.folder / "config" / "tiny.yaml").write_text("study: [", encoding="utf-8")
    study = [sys.executable, "workflow/scripts/study.py", "-j2", "--configfile", "config/tiny.yaml"]
    run = subprocess.run(study, cwd=fresh.folder, capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stderr.startswith("make study: config/tiny.yaml, line 1: ")
    assert len(run.stderr.splitlines()) == 1


def test_a_scene_is_what_its_text_shows(fresh):
    text = "study: tiny\ngrids: [{n: [0100], phi: [0.8], kt: [-0.0, 1e-8], seeds: 02}]\n"
    (fresh.folder / "config" / "tiny.yaml").write_text(text, encoding="utf-8")
    plan = fresh.run("-n")
    assert "results/tiny/points/n~100/phi~0.8/kt~0.0.nc" in plan
    assert "results/tiny/points/n~100/phi~0.8/kt~1e-08.nc" in plan
    plan = fresh.run("-n", "--config", "study=other", "effects={friction: true}", "seeds_per_job=1")
    assert "results/other/rigidity/n~100/phi~0.8/kt~0.0/seeds~0001-0001.nc" in plan


def test_several_files_of_a_scene_are_merged(fresh):
    more = fresh.folder / "config" / "more.yaml"
    more.write_text(json.dumps({"seeds_per_job": 1}), encoding="utf-8")
    plan = said(snakemake(fresh.folder, "-n", "--configfile", "config/tiny.yaml", str(more)))
    assert jobs_in(plan)["rigidity"] == 8
