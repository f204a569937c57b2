"""Every rule of the workflow with some of its jobs, for each scene that is given, as JSON.

    python rules_of_scenes.py SNAKEFILE SCENE…

The workflow is parsed, not run. From one point of every n and every grid the rules are followed
back to their first files; a job is what a rule makes of its wildcards.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

from snakemake.api import OutputSettings, ResourceSettings, SnakemakeApi
from snakemake.settings.types import ConfigSettings, Quietness

from grainmodes.configuration import Scene, read_scene
from grainmodes.parameters.grid import format_value


def main(snakefile: str, *scenes: str) -> None:
    """Print a list of rules; see `rules_of`."""
    print(json.dumps([row for scene in scenes for row in rules_of(snakefile, scene)]))


def rules_of(snakefile: str, path: str) -> Iterator[dict]:
    """The rules with a command of the workflow of a scene, each with its jobs."""
    with SnakemakeApi(OutputSettings(quiet={Quietness.ALL})) as api:
        workflow = api.workflow(
            ResourceSettings(cores=64),
            config_settings=ConfigSettings(configfiles=[Path(path)]),
            snakefile=Path(snakefile),
        )._workflow
    found = {rule: [] for rule in workflow.rules if rule.shellcmd}
    for rule, wildcards in _jobs(workflow, _targets(read_scene(path))):
        found[rule].append(_job(rule, wildcards))
    for rule, jobs in found.items():
        yield {
            "scene": Path(path).stem,
            "rule": rule.name,
            "command": rule.shellcmd,
            "log": [str(log) for log in rule.log],
            "benchmark": str(rule.benchmark or ""),
            "has": sorted(rule.resources),
            "jobs": jobs,
        }


def _targets(scene: Scene) -> list[str]:
    """One point of every n of every grid, and all that is made of the ensemble."""
    points = [
        next(p for p in grid.points if p.n == n and p.kt == max(grid.kt))
        for grid in scene.grids
        for n in grid.n
    ]
    names = ({key: format_value(value) for key, value in vars(point).items()} for point in points)
    study = f"results/{scene.study}"
    files = [f"{study}/points/n~{n['n']}/phi~{n['phi']}/kt~{n['kt']}.nc" for n in names]
    ends = ["claims.md", "checks.passed", *(f"figures/{name}.png" for name in scene.figures)]
    ends += ["figures/release_spirals.gif"] * ("release_spirals" in scene.figures)
    measured = [f"results/accuracy/{size}/spectrum.png" for size in ("small", "large")]
    return [*files, f"{study}/ensemble.nc", *(f"{study}/{end}" for end in ends), *measured]


def _jobs(workflow, targets: list[str]) -> Iterator[tuple]:
    """The jobs behind some files, each once; an ensemble does not lead to further points."""
    seen, made, waiting = set(), set(), list(targets)
    rules = [rule for rule in workflow.rules if rule.shellcmd]
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        for rule in rules:
            if rule.is_producer(path):
                wildcards = rule.get_wildcards(path)
                job = (rule.name, *wildcards.items())
                if job not in made:
                    made.add(job)
                    yield rule, wildcards
                    waiting += _behind(rule, wildcards)
    for rule in rules:
        if not rule.output:
            yield rule, {}


def _behind(rule, wildcards) -> list[str]:
    """The results that a job reads: one block of each stage of a point, and of an ensemble none."""
    if rule.name == "ensemble":
        return []
    files = [str(file) for file in rule.expand_input(wildcards)[0]]
    results = [file for file in files if file.startswith("results/")]
    if rule.name != "point":
        return results
    return list({file.split("/")[2]: file for file in results}.values())


def _job(rule, wildcards) -> dict:
    """What a job asks for, at its first and its second attempt."""
    first, second = (rule.expand_resources(wildcards, None, attempt=k) for k in (1, 2))
    return {
        "wildcards": dict(wildcards),
        "log": [str(log) for log in rule.expand_log(wildcards)],
        "benchmark": str(rule.expand_benchmark(wildcards)),
        "threads": first["_cores"],
        "mem_mb": [first.get("mem_mb"), second.get("mem_mb")],
        "runtime": [first.get("runtime"), second.get("runtime")],
    }


if __name__ == "__main__":
    main(*sys.argv[1:])
