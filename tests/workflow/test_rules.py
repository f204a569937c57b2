"""Every rule of every scene that comes with the project keeps a log and a benchmark, and asks for
memory, time and threads that follow from its N, its block of seeds and its settings."""

import json
import subprocess
import sys

import pytest

from grainmodes.configuration import read_scene
from grainmodes.cost import read_table, resources
from grainmodes.parameters.grid import Point, parse_seeds
from grainmodes.parameters.stages import STAGES

from .conftest import CHECKOUT

SCENES = sorted((CHECKOUT / "config").glob("*.yaml"))
TABLE = read_table()


@pytest.fixture(scope="module")
def rules():
    """The rules of all scenes, with some jobs each."""
    script = CHECKOUT / "tests" / "helpers" / "rules_of_scenes.py"
    command = [sys.executable, str(script), "Snakefile", *map(str, SCENES)]
    run = subprocess.run(command, cwd=CHECKOUT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


@pytest.fixture(scope="module")
def jobs(rules):
    """(scene, rule, job) of every job."""
    return [(row["scene"], row["rule"], job) for row in rules for job in row["jobs"]]


def test_every_scene_and_every_rule_is_looked_at(rules, jobs):
    assert {row["scene"] for row in rules} == {path.stem for path in SCENES}
    used = {rule for _, rule, _ in jobs}
    assert used == {row["rule"] for row in rules}
    assert used >= STAGES.keys()


def test_every_rule_keeps_a_log_of_its_own(rules, jobs):
    for row in rules:
        assert row["log"], row["rule"]
        assert row["benchmark"], row["rule"]
        assert row["command"].endswith(" 2>&1 | tee {log} >&2"), row["rule"]
    kept = [(scene, path) for scene, _, job in jobs for path in (*job["log"], job["benchmark"])]
    assert len(kept) == len(set(kept)) == 2 * len(jobs)
    for scene, path in kept:
        assert path.startswith("logs/"), f"{path}: {scene} keeps it among results"
        assert "{" not in path


def test_every_job_asks_for_memory_time_and_threads(jobs):
    for scene, rule, job in jobs:
        (memory, more), (time, longer) = job["mem_mb"], job["runtime"]
        assert memory > TABLE.job["megabytes"], (scene, rule)
        assert time > 0
        assert 1 <= job["threads"] <= resources.MOST_THREADS
        assert (more, longer) == (2 * memory, 2 * time), "a second attempt"


def test_a_stage_asks_for_what_its_growth_law_says(jobs):
    scenes = {path.stem: read_scene(path) for path in SCENES}
    looked_at = set()
    for name, rule, job in jobs:
        if rule not in STAGES:
            continue
        values = job["wildcards"]
        point = Point(int(values["n"]), float(values["phi"]), float(values.get("kt", 0.0)))
        samples = 1 if STAGES[rule].single_sample else len(parse_seeds(values["seeds"]))
        cost = resources.stage_job(scenes[name], TABLE, rule, point, samples)
        assert job["threads"] == resources.threads(cost)
        assert job["mem_mb"][0] == resources.megabytes(cost, TABLE, job["threads"])
        assert job["runtime"][0] == resources.minutes(cost, TABLE, job["threads"])
        looked_at.add((rule, point.n))
    assert len(looked_at) > 2 * len(STAGES)


@pytest.mark.parametrize("rule", ["compress", "rigidity", "spectrum", "shear", "checks", "figure"])
def test_no_rule_asks_for_a_constant(rule, jobs):
    asked = {tuple(job["mem_mb"]) for _, name, job in jobs if name == rule}
    assert len(asked) > 1
