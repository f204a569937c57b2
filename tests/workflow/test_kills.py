"""A killed run resumes, and ends with the same bytes as an unbroken one."""

import os
import signal
import subprocess
import sys
import time

import psutil
import pytest

from .conftest import INSTALLED, Study


@pytest.fixture
def fresh(fresh) -> Study:
    """The study before its first run, to be run as a user does."""
    return Study(fresh.folder, INSTALLED)


def start(study) -> subprocess.Popen:
    """Snakemake in the background, in a process group of its own."""
    return subprocess.Popen(
        study.command("--rerun-incomplete"),
        cwd=study.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def wait_for(happens, run: subprocess.Popen):
    """Whatever true value `happens` returns first, while `run` lives."""
    while run.poll() is None:
        found = happens()
        if found:
            return found
        time.sleep(0.005)
    raise AssertionError("the run ended before it could be killed")


def jobs_of(run: subprocess.Popen, command: str) -> list[psutil.Process]:
    """Processes of a `grainmodes` command under a run."""
    found = []
    for child in psutil.Process(run.pid).children(recursive=True):
        try:
            words = child.cmdline()
        except psutil.Error:
            continue
        if len(words) > 2 and words[1].endswith("/grainmodes") and words[2] == command:
            found.append(child)
    return found


def resume(study) -> subprocess.CompletedProcess:
    """What `make study` runs."""
    return subprocess.run(
        [sys.executable, "workflow/scripts/study.py", "-j2", "--configfile", "config/tiny.yaml"],
        cwd=study.folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=900,
    )


@pytest.mark.slow
def test_killed_runs_end_with_the_same_bytes(fresh, built):
    run = start(fresh)
    job = wait_for(lambda: jobs_of(run, "compress"), run)[0]
    job.kill()
    assert run.wait(timeout=600) != 0

    run = start(fresh)
    wait_for(lambda: jobs_of(run, "spectrum"), run)
    os.kill(run.pid, signal.SIGKILL)
    run.wait()
    said = fresh.run(succeeds=False)
    assert "--unlock" in said or "--rerun-incomplete" in said

    finished = resume(fresh)
    assert finished.returncode == 0, finished.stdout
    assert fresh.fingerprints() == built.fingerprints()
    assert "Nothing to be done" in fresh.run()
