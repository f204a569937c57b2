"""The cost of a scene: growth laws, as many jobs as the workflow has, and sums."""

import re
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import yaml

from benchmarks import growth
from grainmodes.cli import main
from grainmodes.configuration import read_scene, scene_of
from grainmodes.cost import COSTS, Law, estimate, read_table, wall_seconds
from grainmodes.cost.work import work
from grainmodes.parameters.protocol import Compression, SpectrumChoices


class Timed(NamedTuple):
    """What a measurement returns."""

    seconds: float
    units: float
    megabytes: float


CONFIG = Path(__file__).parents[2] / "config"
TABLE = read_table()
FREE = replace(TABLE, job={"seconds": 0.0, "megabytes": 180.0})
ONLY_G = {"step_strain": False, "spectrum": "none"}
GRID = {"n": [64], "phi": [0.85, 0.9], "kt": [1e-4, 1.0], "seeds": 4, "observables": ONLY_G}


def scene_with(*changes: dict, **keys):
    """A scene of the small grid, once for every dictionary of changes."""
    return scene_of({"study": "small", "grids": [GRID | change for change in changes], **keys})


def observing(**observables) -> dict:
    """A change of the observables of the small grid."""
    return {"observables": ONLY_G | observables}


def priced(scene, stage: str, table=FREE) -> float:
    """CPU seconds of a stage."""
    return sum(item.seconds for item in estimate(scene, table) if item.stage == stage)


def total(scene) -> float:
    """CPU seconds of a scene, start-up of jobs aside."""
    return sum(item.seconds for item in estimate(scene, FREE))


def jobs(scene) -> dict[str, int]:
    """Stage → number of jobs."""
    found: dict[str, int] = {}
    for item in estimate(scene, TABLE):
        found[item.stage] = found.get(item.stage, 0) + item.jobs
    return found


def test_a_law_is_a_power_of_n():
    law = Law(2.0, 1.5, 10.0, 1.0, up_to=4096)
    assert law.seconds_at(1024) == 2.0
    assert law.seconds_at(4096) == pytest.approx(2.0 * 8)
    assert law.megabytes_at(512) == pytest.approx(5.0)


def test_every_law_of_the_table_is_used():
    every = {"rigidity", "step_strain", "fields", "probes"}
    used = {"trajectory", "pack"} | every
    for factorisation in ("superlu", "pardiso"):
        choices = SpectrumChoices(factorisation=factorisation)
        for kind in ("counts", "bands", "eigenvalues", "modes"):
            for n in (64, 65536):
                used |= set(work("spectrum", kind, n, 1.0, choices, TABLE))
    assert used == set(TABLE.laws)


@pytest.mark.parametrize("stage", ["compress", "pack", "rigidity"])
def test_costs_grow_as_the_table_says(stage):
    law = TABLE.laws[{"compress": "trajectory"}.get(stage, stage)]
    small, large = (priced(scene_with({"n": [n]}), stage) for n in (64, 1024))
    assert large / small == pytest.approx(16**law.exponent)


def test_costs_are_samples_times_the_law():
    assert priced(scene_with({"n": [1024]}), "rigidity") == pytest.approx(
        4 * 4 * TABLE.laws["rigidity"].seconds
    )
    assert priced(scene_with({"n": [1024], "seeds": 8}), "compress") == pytest.approx(
        8 * TABLE.laws["trajectory"].seconds
    )


def test_a_trajectory_ends_at_its_highest_fraction():
    law = TABLE.laws["trajectory"].seconds_at(64)
    assert priced(scene_with({"phi": [0.84, 0.83]}), "compress") == pytest.approx(
        4 * law * TABLE.climb[0.84]
    )
    halfway = (TABLE.climb[0.83] + TABLE.climb[0.84]) / 2
    assert TABLE.share(0.835) == pytest.approx(halfway)
    assert TABLE.share(0.91) > TABLE.share(0.9) == 1.0
    packed = priced(scene_with({"phi": [0.835]}), "pack") / 4
    assert packed - TABLE.laws["pack"].seconds_at(64) == pytest.approx(
        law * (halfway - TABLE.climb[0.83])
    )


def test_other_compressions_cost_more():
    assert TABLE.slowdown(Compression()) == 1.0
    assert TABLE.slowdown(Compression(phi_step=1e-3)) == pytest.approx(1 / 5.5, rel=0.01)
    assert TABLE.slowdown(Compression(relaxation="fire")) > 50
    fire = {"compression": {"relaxation": "fire"}}
    assert priced(scene_with({}, protocol=fire), "compress") > 50 * priced(
        scene_with({}), "compress"
    )


def test_two_grids_cost_their_sum():
    one, other = {}, {"n": [128], "phi": [0.87]} | observing(spectrum="modes", fields=True)
    together = total(scene_with(one, other))
    assert together == pytest.approx(total(scene_with(one)) + total(scene_with(other)))
    assert together > 2 * total(scene_with(one))


def test_several_n_in_a_grid_cost_as_much_as_in_grids_of_their_own():
    asked = observing(spectrum="modes", fields=True)
    whole = scene_with({"n": [64, 128]} | asked)
    split = scene_with({"n": [64]} | asked, {"n": [128]} | asked)
    assert total(whole) == pytest.approx(total(split))
    assert jobs(whole) == jobs(split)


def test_fields_are_those_of_one_sample():
    items = estimate(scene_with({"n": [1024]} | observing(fields=True)), FREE)
    (fields,) = [item for item in items if item.stage == "fields"]
    assert fields.samples == fields.jobs == 4
    assert fields.seconds == pytest.approx(4 * TABLE.laws["fields"].seconds)


def test_every_job_has_its_start_up():
    scene = scene_with({})
    dear = replace(TABLE, job=TABLE.job | {"seconds": 100.0})
    started = sum(item.seconds for item in estimate(scene, dear)) - total(scene)
    assert started == pytest.approx(100.0 * sum(jobs(scene).values()))


def test_a_work_is_known_as_far_as_its_least_known_law():
    laws = {"count_superlu": 4096, "window_superlu": 1024}
    known = {name: replace(TABLE.laws[name], up_to=n) for name, n in laws.items()}
    table = replace(TABLE, laws=TABLE.laws | known)
    choices = {"spectrum": {"factorisation": "superlu"}}
    scene = scene_with({"n": [4096]} | observing(spectrum="bands"), protocol=choices)
    (bands,) = [item for item in estimate(scene, table) if item.stage == "spectrum"]
    assert bands.up_to == 1024


def test_grids_of_one_n_share_their_packings():
    whole = scene_with({"kt": [1e-4, 1e-2, 1.0]})
    split = scene_with({"kt": [1e-4]}, {"kt": [1e-2, 1.0]})
    assert total(split) == pytest.approx(total(whole))
    assert jobs(split) == jobs(whole)


def test_jobs_are_those_of_the_workflow():
    grids = [
        {"phi": [0.8], "seeds": 4} | observing(step_strain=True),
        {"phi": [0.85], "kt": [1.0], "seeds": 2} | observing(spectrum="counts", hessian=True),
        {"phi": [0.85], "kt": [0.0], "seeds": 2} | observing(spectrum="modes", fields=True),
    ]
    scene = scene_with(*grids, block=2, figures=["dos"])
    assert jobs(scene) == {
        "compress": 7,
        "pack": 3,
        "rigidity": 6,
        "step_strain": 4,
        "spectrum": 2,
        "spectrum_hessian": 1,
        "fields": 1,
        "gather": 4 + 2 + 1,
    }


CHOICES = SpectrumChoices(factorisation="superlu", fineness=1.0)


@pytest.mark.parametrize(
    ("kind", "n", "method", "units"),
    [
        ("counts", 256, "auto", {"dense_values": 1}),
        ("counts", 4096, "auto", {"count_superlu": 641}),
        ("counts", 256, "counting", {"count_superlu": 641}),
        ("counts", 4096, "dense", {"dense_values": 1}),
        ("bands", 256, "auto", {"dense_modes": 1}),
        ("bands", 65536, "auto", {"count_superlu": 8 * 641, "window_superlu": 60 * 641}),
        ("bands", 4096, "auto", {"count_superlu": 8 * 641, "window_superlu": 3 * 4096}),
        ("eigenvalues", 1024, "auto", {"dense_values": 1}),
        ("modes", 1024, "auto", {"dense_modes": 1}),
        ("modes", 1024, "windows", {"window_superlu": 3 * 1024}),
        ("modes", 4096, "auto", {"window_superlu": 3 * 4096}),
        ("modes", 4096, "dense", {"dense_modes": 1}),
    ],
)
def test_a_spectrum_is_the_work_of_its_method(kind, n, method, units):
    choices = replace(CHOICES, method=method)
    assert work("spectrum", kind, n, 1.0, choices, TABLE) == units
    assert work("spectrum_rattlers", kind, n, 1.0, choices, TABLE) == units


def test_without_rotation_there_is_less_of_a_spectrum():
    choices = replace(CHOICES, method="windows")
    assert work("spectrum", "modes", 1024, 0.0, choices, TABLE) == {"window_superlu": 2048}
    assert work("spectrum", "counts", 4096, 0.0, choices, TABLE) == {"count_superlu": 541}


def test_two_hessians_are_counted_whatever_the_spectrum():
    assert work("spectrum_hessian", "modes", 4096, 1.0, CHOICES, TABLE) == {"count_superlu": 1282}


def test_wall_time_is_shared_work_or_the_longest_chain():
    items = estimate(scene_with({}), TABLE)
    work_of_all = sum(item.seconds for item in items)
    assert wall_seconds(items, 1) == pytest.approx(work_of_all)
    chain = sum(item.chain for item in items)
    assert wall_seconds(items, 1000) == pytest.approx(chain)
    assert chain < work_of_all


def test_the_longest_chain_ends_in_the_longest_response():
    grids = [{"n": [64]}, {"n": [2048], "seeds": 1} | observing(step_strain=True)]
    items = estimate(scene_with(*grids, block=1), FREE)
    large = [item for item in items if item.n == 2048]
    chain = {item.stage: item.chain for item in large}
    assert wall_seconds(items, 1000) == pytest.approx(
        chain["compress"] + chain["pack"] + max(chain["rigidity"], chain["step_strain"])
    )
    assert chain["rigidity"] != chain["step_strain"]


def test_memory_is_that_of_the_largest_work():
    scene = scene_with({"n": [1024]} | observing(spectrum="modes"))
    peaks = {item.stage: item.megabytes for item in estimate(scene, TABLE)}
    assert peaks["spectrum"] == TABLE.job["megabytes"] + TABLE.laws["dense_modes"].megabytes


def test_a_fit_finds_the_power_of_the_largest_sizes():
    sizes = [64, 256, 512, 1024, 2048]
    fit = growth.fitted(sizes, [1e3, *(0.3 * (n / 1024) ** 1.4 for n in sizes[1:])])
    assert fit[:2] == pytest.approx((0.3, 1.4))
    assert max(fit[2:]) < 1e-9


def test_a_fit_states_its_error():
    draws = np.random.default_rng(1)
    sizes = [512, 1024, 2048, 4096]
    exact = np.array([0.3 * (n / 1024) ** 1.4 for n in sizes])
    fits = [growth.fitted(sizes, exact * np.exp(draws.normal(0, 0.1, 4))) for _ in range(400)]
    spread = np.std([fit.p for fit in fits])
    assert np.sqrt(np.mean([fit.p_error**2 for fit in fits])) == pytest.approx(spread, rel=0.15)
    spread = np.std([np.log(fit.c) for fit in fits])
    assert np.sqrt(np.mean([fit.c_error**2 for fit in fits])) == pytest.approx(spread, rel=0.15)
    assert np.isnan(growth.fitted(sizes[:2], exact[:2]).p_error)


def test_growth_writes_a_table_and_stops_in_time(monkeypatch, tmp_path):
    asked = []

    def apart(function, *arguments):
        if function != "timed":
            return {"bare": 150.0, "start_up": 0.5, "climb": [3.0, 1.0] + [0.0] * 9}[function]
        work, n, _ = arguments
        asked.append((work, n))
        units = 4.0 if work == "count_superlu" else 1.0
        return Timed(2.0 * (n / 1024) ** 3, units, 150.0 + n / 100)

    monkeypatch.setattr(growth, "apart", apart)
    monkeypatch.setattr(growth, "find_spec", lambda name: None)
    growth.main(tmp_path / "costs.yaml")
    table = read_table(tmp_path / "costs.yaml")
    assert table.laws["rigidity"] == Law(2.0, 3.0, 10.2, 1.0, 2048)
    assert table.laws["count_superlu"].seconds == 0.5
    assert table.laws["count_pardiso"] == TABLE.laws["count_pardiso"]
    assert max(n for _, n in asked) == 2048
    assert table.job == {"seconds": 0.5, "megabytes": 150}
    assert table.share(0.80) == 0.75
    assert table.disk == TABLE.disk


def said(capsys, *words: str) -> str:
    """What the command prints."""
    assert main(["cost", *words]) == 0
    return capsys.readouterr().out


def test_the_default_scene_is_priced(capsys):
    lines = said(capsys, str(CONFIG / "default.yaml")).splitlines()
    assert lines[0] == "default: 68 points on 6 grids"
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
    content["laws"]["probes"]["up_to"] = 0
    (tmp_path / "costs.yaml").write_text(yaml.safe_dump(content))
    text = said(capsys, str(CONFIG / "default.yaml"), "--costs", str(tmp_path / "costs.yaml"))
    marks = {line.split()[0]: line[-1] for line in text.splitlines() if line[-1:] in ("*", "?")}
    assert marks["rigidity"] == "*"
    assert marks["probes"] == "?"
    assert "step_strain" not in marks
    assert "* beyond the largest N that was measured" in text
    assert "? never measured: a guess" in text


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"colour": 1}, "unknown key 'colour', allowed are study, grids"),
        ({"grids": [GRID | {"n": [4]}]}, "grids[0].n = 4: at phi = 0.9 the box is 1.62 d wide"),
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
    assert "costs.yaml: not a table of costs" in line


def test_there_is_a_core_at_least(capsys):
    assert main(["cost", str(CONFIG / "default.yaml"), "--cores", "0"]) == 1
    assert "--cores = 0: allowed is a whole number from 1" in capsys.readouterr().err
