"""Nothing that a command has started outlives it, and nothing half-written stays."""

import json
import os
import signal
import subprocess
import sys
import time
import uuid
from pathlib import Path

import psutil
import pytest

from grainmodes.runtime.partial_files import partial_path, remove_partial_files_in
from grainmodes.runtime.processes import Process
from grainmodes.runtime.supervisor import WORKFLOW
from marked_processes import marked_processes

COMMAND = """
import signal, sys
from pathlib import Path
from grainmodes.runtime.supervisor import supervised

def run():
{body}

signal.signal(signal.SIGHUP, signal.SIG_DFL)  # where the tests run under `nohup`
sys.exit(supervised(run, "grainmodes test", [Path(sys.argv[1])]))
"""

WRITES = """
    from grainmodes.runtime.atomic import replaced
    with replaced(sys.argv[1]) as partial:
        partial.write_text("half")
        print("ready", flush=True)
        import ctypes
        ctypes.PyDLL(None).sleep(600)  # keeps Python's lock
"""

SHARES = """
    import os, time
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context
    from grainmodes.runtime.processes import end_with_parent
    with ProcessPoolExecutor(3, get_context("fork"), end_with_parent) as pool:
        waiting = [pool.submit(time.sleep, 600) for _ in range(3)]
        print("ready", flush=True)
        waiting[0].result()
"""

NOTHING_LIVES_AFTER = 2.0
"""Seconds."""


class Command:
    """A command in the background; its processes are known by a word in their environment."""

    def __init__(self, body: str, output: Path, **environment: str):
        self.word = uuid.uuid4().hex
        self.process = subprocess.Popen(
            [sys.executable, "-c", COMMAND.format(body=body), str(output)],
            env=os.environ | {"MARKED": self.word} | environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def ready(self, count: int) -> list[psutil.Process]:
        """Its processes, once there are so many."""
        assert self.process.stdout.readline() == "ready\n"
        while len(self.alive()) < count:
            time.sleep(0.01)
        return self.alive()

    def alive(self) -> list[psutil.Process]:
        """Its processes that live."""
        return marked_processes(self.word)

    def end(self) -> tuple[int, str]:
        """Its exit status and what it said, once all of its processes have ended."""
        status, last = self.process.wait(timeout=10), time.monotonic() + NOTHING_LIVES_AFTER
        while self.alive():
            assert time.monotonic() < last, self.alive()
            time.sleep(0.02)
        return status, self.process.stderr.read()


@pytest.fixture
def command(tmp_path):
    """Starts commands; ends what is left of them."""
    started = []

    def start(body: str, **environment: str) -> Command:
        started.append(Command(body, tmp_path / "out.nc", **environment))
        return started[-1]

    yield start
    for one in started:
        for process in one.alive():
            process.kill()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
@pytest.mark.parametrize(("body", "count"), [(WRITES, 2), (SHARES, 5)])
def test_a_signal_ends_all_processes_at_once(command, tmp_path, number, body, count):
    one = command(body)
    one.ready(count)
    start = time.monotonic()
    one.process.send_signal(number)
    status, said = one.end()
    assert time.monotonic() - start < NOTHING_LIVES_AFTER
    assert status == -number
    assert said.splitlines() == [
        f"grainmodes test: ended by {number.name}; no half-written file is left, "
        "and it can be run again"
    ]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("body", "count"), [(WRITES, 2), (SHARES, 5)])
def test_a_kill_of_the_supervisor_leaves_no_process(command, body, count):
    one = command(body)
    one.ready(count)
    one.process.kill()
    assert one.end()[0] == -signal.SIGKILL


@pytest.mark.parametrize(("body", "count"), [(WRITES, 2), (SHARES, 5)])
def test_a_kill_of_what_computes_is_told(command, tmp_path, body, count):
    """As by the system, where memory is short."""
    one = command(body)
    child = one.ready(count)[1]
    child.kill()
    status, said = one.end()
    assert status == 128 + signal.SIGKILL
    assert said.count("\n") == 1
    assert "ended by SIGKILL, which the system sends where memory is short" in said
    assert list(tmp_path.iterdir()) == []


def test_a_command_ends_with_its_workflow(command, tmp_path):
    with subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"]) as workflow:
        owner = json.dumps(Process.with_number(workflow.pid)._asdict())
        one = command(WRITES, **{WORKFLOW: owner})
        one.ready(2)
        workflow.kill()
        status, said = one.end()
    assert status == 128 + signal.SIGKILL
    assert said.count("\n") == 1
    assert f"the workflow that started it has ended (process {workflow.pid} on" in said
    assert list(tmp_path.iterdir()) == []


def test_a_workflow_of_another_machine_does_not_end_it(command):
    owner = Process.current()._replace(place="elsewhere", start="1")
    one = command("    print('ready', flush=True)", **{WORKFLOW: json.dumps(owner._asdict())})
    assert one.end() == (0, "")


def test_a_command_outlives_the_shell_that_started_it(tmp_path):
    """As under nohup."""
    script = COMMAND.format(body="    import time; time.sleep(2.0); print('done', flush=True)")
    (tmp_path / "command.py").write_text(script, encoding="utf-8")
    (tmp_path / "said").touch()
    words = f"nohup {sys.executable} {tmp_path}/command.py {tmp_path}/out.nc > {tmp_path}/said &"
    subprocess.run(["bash", "-c", words], check=True, timeout=1.5)
    deadline = time.monotonic() + 20.0
    while "done" not in (tmp_path / "said").read_text(encoding="utf-8"):
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_of_two_commands_on_one_file_the_second_waits(command, tmp_path):
    slow = "    import time; print('ready', flush=True); time.sleep(1.5); Path(sys.argv[1]).touch()"
    first = command(slow)
    first.ready(2)
    second = command("    assert Path(sys.argv[1]).exists()")
    status, said = second.end()
    assert status == 0, said
    assert f"to be written: waiting for process {first.process.pid}" in said
    assert first.end()[0] == 0
    assert [path.name for path in tmp_path.iterdir()] == ["out.nc"]


def test_the_next_run_removes_what_a_killed_one_left(command, tmp_path):
    one = command(WRITES)
    one.ready(2)
    one.process.kill()
    one.end()
    left = {path.name for path in tmp_path.iterdir()}
    assert len(left) == 2  # the claim, and the half file
    elsewhere = tmp_path / ".out.nc.01234567-12-345.partial"
    other_file = tmp_path / ".other.nc.01234567-12-345.partial"
    for path in (elsewhere, other_file):
        path.touch()
    assert command("    pass").end() == (0, "")
    assert list(tmp_path.iterdir()) == [other_file]


def test_a_file_that_is_being_written_stays(tmp_path):
    own, elsewhere = partial_path(tmp_path / "a.nc"), tmp_path / ".b.nc.01234567-12-345.partial"
    for path in (own, elsewhere):
        path.touch()
    now = elsewhere.stat().st_mtime
    remove_partial_files_in(tmp_path, now + 60.0)
    assert {*tmp_path.iterdir()} == {own, elsewhere}
    remove_partial_files_in(tmp_path, now + 3601.0)
    assert [*tmp_path.iterdir()] == [own]
