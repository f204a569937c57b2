"""One run at a time in a folder, and no job that outlives its run."""

import os
import signal
import subprocess
import sys
import time
import uuid

import psutil
import pytest

from marked_processes import marked_processes

from .conftest import INSTALLED, Study

MAKE_STUDY = [sys.executable, "workflow/scripts/study.py"]
"""What `make study` runs."""

TARGET = "results/tiny/trajectories/n~16/phi~0.85/seeds~0000-0001.nc"


class Run:
    """A run in the background; its processes are known by a word in their environment."""

    def __init__(self, study: Study, launcher: list[str], *words: str):
        self.study, self.word = study, uuid.uuid4().hex
        self.process = subprocess.Popen(
            [*launcher, *words, "-j2", "--configfile", "config/tiny.yaml"],
            cwd=study.folder,
            env=os.environ | {"MARKED": self.word},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def alive(self) -> list[psutil.Process]:
        """Its processes."""
        return marked_processes(self.word)

    def wait_for_job(self, command: str) -> None:
        """Wait until a job runs a `grainmodes` command."""
        while not any(command in " ".join(words_of(process)) for process in self.alive()):
            assert self.process.poll() is None, self.process.stdout.read()
            time.sleep(0.02)

    def end(self) -> tuple[int, str]:
        """Its exit status, and what it said."""
        said, _ = self.process.communicate(timeout=600)
        return self.process.returncode, said


def words_of(process: psutil.Process) -> list[str]:
    """The command line of a process that may have ended."""
    try:
        return process.cmdline()
    except psutil.Error:
        return []


@pytest.fixture
def start(fresh):
    """Starts runs in the study before its first run; ends what is left of them."""
    started: list[Run] = []

    def begin(launcher: list[str], *words: str) -> Run:
        started.append(Run(Study(fresh.folder), launcher, *words))
        return started[-1]

    yield begin
    for run in started:
        for process in run.alive():
            process.kill()


def nothing_lives(run: Run, seconds: float = 3.0) -> None:
    """Check that a run leaves no process."""
    last = time.monotonic() + seconds
    while left := run.alive():
        assert time.monotonic() < last, [words_of(process) for process in left]
        time.sleep(0.05)


@pytest.mark.parametrize("launcher", [MAKE_STUDY, INSTALLED], ids=["make", "snakemake"])
def test_jobs_end_with_a_killed_snakemake_and_the_next_run_goes_on(start, launcher):
    run = start(launcher, TARGET)
    run.wait_for_job("grainmodes compress")
    run.process.kill()
    nothing_lives(run)
    assert any((run.study.folder / ".snakemake" / "locks").iterdir())
    half = run.study.results / "trajectories" / ".old.nc.01234567-1-1.partial"
    half.parent.mkdir(parents=True, exist_ok=True)
    half.touch()
    os.utime(half, (0, 0))
    status, said = start(MAKE_STUDY, TARGET).end()
    assert status == 0, said
    assert (run.study.folder / TARGET).is_file()
    hidden = [path for path in run.study.results.rglob("*") if path.name.startswith(".")]
    assert hidden == []
    assert not (run.study.folder / ".snakemake" / "run.claim").exists()


def test_jobs_end_with_a_terminated_group(start):
    run = start(INSTALLED, TARGET)
    run.wait_for_job("grainmodes compress")
    os.killpg(run.process.pid, signal.SIGINT)
    run.end()
    nothing_lives(run)


@pytest.mark.parametrize("first", [MAKE_STUDY, INSTALLED], ids=["make", "snakemake"])
def test_a_second_run_ends_with_a_sentence_and_touches_nothing(start, first):
    run = start(first, TARGET)
    run.wait_for_job("grainmodes compress")
    sentence = f"expected no other run, got process {run.process.pid} on "
    for second in (MAKE_STUDY, INSTALLED):
        status, said = start(second, TARGET).end()
        assert status == 1
        assert sentence in said, said
        if second is MAKE_STUDY:
            assert said.count("\n") == 1
    status, said = start(INSTALLED, "-n", "--rerun-incomplete", TARGET).end()
    assert status == 0, said  # to look is allowed
    status, said = run.end()
    assert status == 0, said


def test_of_runs_that_start_at_once_on_a_stale_lock_one_works(start):
    killed = start(MAKE_STUDY, TARGET)
    killed.wait_for_job("grainmodes compress")
    killed.process.kill()
    nothing_lives(killed)
    runs = [start(MAKE_STUDY, TARGET) for _ in range(3)]
    ends = [run.end() for run in runs]
    assert sorted(status for status, _ in ends) == [0, 1, 1], ends
    assert all("expected no other run" in said for status, said in ends if status)
