"""Every job keeps what it printed and what it took, beside the results and not among them."""

import csv

import pytest

from .conftest import Study

SPECTRUM = "spectrum/n~16/phi~0.85/kt~1.0/seeds~0000-0001"


def kept(study: Study, suffix: str) -> set[str]:
    """Names of the files with this suffix that jobs have left."""
    logs = study.folder / "logs" / "tiny"
    return {p.relative_to(logs).with_suffix("").as_posix() for p in logs.rglob(f"*{suffix}")}


def test_every_job_has_left_a_log_and_a_benchmark(built):
    logs, benchmarks = kept(built, ".log"), kept(built, ".tsv")
    assert logs == benchmarks
    assert {SPECTRUM, "ensemble", "checks", "passed", "claims", "figure/dos"} <= logs
    results = {p.relative_to(built.results).as_posix() for p in built.results.rglob("*.nc")}
    made_of = {"trajectories": "compress", "packings": "equilibrate", "points": "point"}
    for path in results:
        folder, _, rest = path.removesuffix(".nc").partition("/")
        assert f"{made_of.get(folder, folder)}{'/' if rest else ''}{rest}" in logs
    with open(built.folder / "logs" / "tiny" / f"{SPECTRUM}.tsv", encoding="utf-8") as file:
        (row,) = csv.DictReader(file, delimiter="\t")
    assert float(row["s"]) > 0


def test_neither_is_a_result(built):
    assert not [path for path in built.results.rglob("*") if path.suffix in (".log", ".tsv")]


def test_a_lost_log_or_benchmark_makes_nothing_again(study):
    for suffix in (".log", ".tsv"):
        (study.folder / "logs" / "tiny" / f"{SPECTRUM}{suffix}").unlink()
    assert "Nothing to be done" in study.run()


@pytest.fixture
def spoilt(study) -> Study:
    """A study that misses a spectrum whose packings are truncated."""
    (study.results / f"{SPECTRUM}.nc").unlink()
    packings = study.results / "packings" / "n~16" / "phi~0.85" / "seeds~0000-0001.nc"
    packings.write_bytes(packings.read_bytes()[:2000])
    return study


def test_a_mistake_is_told_and_kept(spoilt):
    said = spoilt.run(f"results/tiny/{SPECTRUM}.nc", succeeds=False)
    log = (spoilt.folder / "logs" / "tiny" / f"{SPECTRUM}.log").read_text(encoding="utf-8")
    (sentence,) = [line for line in log.splitlines() if line.startswith("grainmodes spectrum: ")]
    assert sentence in said
    assert f"logs/tiny/{SPECTRUM}.log" in said, "Snakemake names the log of what failed"


def test_failed_checks_are_told_and_kept(study):
    checks = study.results / "checks.txt"
    text = checks.read_text(encoding="utf-8").replace("passed ", "failed ", 1)
    checks.write_text(text, encoding="utf-8")
    said = study.run("results/tiny/checks.passed", succeeds=False)
    log = (study.folder / "logs" / "tiny" / "passed.log").read_text(encoding="utf-8")
    sentence = "Checks have failed: see results/tiny/checks.txt."
    assert sentence in said
    assert sentence in log
    assert [line for line in log.splitlines() if line.startswith("failed ")]
