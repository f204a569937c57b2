"""A claim is stale only if its owner is provably gone."""

import json
import os
import subprocess
import sys
import threading
import time

import pytest

from grainmodes.runtime import claims
from grainmodes.runtime.claims import ClaimedError, owner_of, take
from grainmodes.runtime.processes import Process

ELSEWHERE = Process("another-host", "another system", 12, "345")


@pytest.fixture
def sleeper():
    """A process that lives until it is killed."""
    with subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"]) as process:
        yield process
        process.kill()


@pytest.fixture
def path(tmp_path):
    return tmp_path / ".run.claim"


def write(path, owner: Process) -> None:
    path.write_text(json.dumps(owner._asdict()), encoding="utf-8")


def tried(path, tell=print):
    return take(path, "a study", wait=False, tell=tell)


def test_a_claim_names_its_owner_until_it_is_released(path):
    claim = tried(path)
    assert owner_of(path) == Process.current()
    claim.release()
    assert not path.exists()


def test_its_owner_may_take_it_again(path):
    tried(path)
    tried(path)
    assert owner_of(path) == Process.current()


def test_a_process_of_this_system_is_proven_to_live_and_to_be_gone(path, sleeper):
    owner = Process.with_number(sleeper.pid)
    write(path, owner)
    with pytest.raises(ClaimedError, match=f"expected no other run, got {owner}"):
        tried(path)
    assert owner_of(path) == owner
    sleeper.kill()  # not waited for: a zombie is gone
    while not owner.is_gone:
        time.sleep(0.01)
    tried(path)
    assert owner_of(path) == Process.current()


def test_a_number_that_is_used_again_is_another_process(path, sleeper):
    write(path, Process.with_number(sleeper.pid)._replace(start="1"))
    tried(path)
    assert owner_of(path) == Process.current()


@pytest.mark.parametrize("shift", [-1e9, 0.0, 1e9])
def test_an_owner_elsewhere_lives_as_long_as_it_touches_its_claim(path, monkeypatch, shift):
    """Whatever its clock says."""
    monkeypatch.setattr(claims, "PATIENCE", 2.0)
    write(path, ELSEWHERE)
    end = threading.Event()

    def touch():
        while not end.wait(0.1):
            os.utime(path, (time.time() + shift,) * 2)

    thread = threading.Thread(target=touch)
    thread.start()
    try:
        with pytest.raises(ClaimedError, match="process 12 on another-host"):
            tried(path)
    finally:
        end.set()
        thread.join()


def test_an_owner_elsewhere_that_is_silent_is_gone(path, monkeypatch):
    monkeypatch.setattr(claims, "PATIENCE", 0.5)
    write(path, ELSEWHERE)
    told, start = [], time.monotonic()
    tried(path, told.append)
    assert time.monotonic() - start > 0.5
    assert told == ["a study: waiting for process 12 on another-host"]
    assert owner_of(path) == Process.current()


def test_a_container_of_the_same_machine_is_elsewhere():
    """Its processes have other numbers: of one that lives there, none may be seen here."""
    here = Process.current()
    there = here._replace(number=2**22 + 1, place=f"{here.place} of a container")
    assert not there.is_here
    assert not there.is_gone


def test_a_claim_that_is_just_being_written_is_not_stale(path, monkeypatch):
    monkeypatch.setattr(claims, "PATIENCE", 5.0)
    path.touch()
    threading.Timer(0.3, write, (path, Process.with_number(os.getppid()))).start()
    with pytest.raises(ClaimedError):
        tried(path)


def test_waiting_ends_with_the_owner(path, sleeper):
    write(path, Process.with_number(sleeper.pid))
    threading.Timer(0.5, sleeper.kill).start()
    told = []
    take(path, "a file", wait=True, tell=told.append)
    assert told == [f"a file: waiting for process {sleeper.pid} on {Process.current().host}"]
    assert owner_of(path) == Process.current()


def test_a_stale_claim_that_another_has_replaced_meanwhile_stays_that_of_the_other(path, sleeper):
    """The stale one was read; before it is removed, a faster process has made its own."""
    stale, fresh = ELSEWHERE, Process.with_number(sleeper.pid)
    write(path, fresh)
    claims._remove(path, stale)
    assert owner_of(path) == fresh
    claims._remove(path, fresh)
    assert list(path.parent.iterdir()) == []


CONTENDER = """
import sys, time
from pathlib import Path
from grainmodes.runtime.claims import ClaimedError, take
path, start = Path(sys.argv[1]), Path(sys.argv[2])
print("ready", flush=True)
while not start.exists():
    time.sleep(0.001)
try:
    take(path, "a study", wait=False, tell=str)
    print("won", flush=True)
    time.sleep(2.0)
except ClaimedError:
    print("lost", flush=True)
"""


@pytest.mark.parametrize("stale", [False, True])
def test_of_many_that_try_at_once_one_wins(path, tmp_path, stale):
    if stale:
        write(path, Process.current()._replace(start="1"))
    start = tmp_path / "start"
    run = [sys.executable, "-c", CONTENDER, str(path), str(start)]
    contenders = [subprocess.Popen(run, stdout=subprocess.PIPE, text=True) for _ in range(6)]
    for one in contenders:
        assert one.stdout.readline() == "ready\n"
    start.touch()
    assert sorted(one.communicate()[0] for one in contenders) == ["lost\n"] * 5 + ["won\n"]
