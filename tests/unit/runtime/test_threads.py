"""The threads of all processes of a job are never more than it was given."""

import os
import subprocess
import sys
import time

import pytest

from example_packings import quenched
from grainmodes.dataset.files import write_block
from grainmodes.kernels.laws import Hertz
from grainmodes.runtime.environment import THREAD_VARIABLES
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block

COUNT = """
import sys
from grainmodes.runtime.environment import prepare
prepare(int(sys.argv[1]))
import numpy, scipy.linalg, os
numpy.eye(500) @ numpy.eye(500), scipy.linalg.eigh(numpy.eye(100))
print(len(os.listdir("/proc/self/task")))
"""


def environment(given: str | None) -> dict[str, str]:
    """The environment of a job that was given so many threads."""
    clean = {name: value for name, value in os.environ.items() if name not in THREAD_VARIABLES}
    names = [name for name in THREAD_VARIABLES if name != "NUMBA_NUM_THREADS"]  # as Snakemake does
    return clean | (dict.fromkeys(names, given) if given is not None else {})


@pytest.mark.parametrize(
    ("given", "processes", "expected"),
    [(None, 1, 1), ("8", 8, 1), ("2", 1, 2), ("4", 2, 2), ("1", 4, 1), ("", 1, 1), ("2,2", 2, 1)],
)
def test_processes_share_the_threads_of_a_job(given, processes, expected):
    """With as many cores as threads, each library may have a pool of threads, of which one works.

    So the number is read from what the libraries are told.
    """
    script = (
        "import sys, os\nfrom grainmodes.runtime.environment import THREAD_VARIABLES, prepare\n"
        "prepare(int(sys.argv[1]))\nprint(*{os.environ[name] for name in THREAD_VARIABLES[:-1]})"
    )
    run = [sys.executable, "-c", script, str(processes)]
    said = subprocess.run(run, env=environment(given), capture_output=True, text=True, check=True)
    assert said.stdout == f"{expected}\n"


@pytest.mark.skipif(sys.platform != "linux", reason="counts threads in /proc")
def test_one_of_eight_processes_has_one_thread():
    run = [sys.executable, "-c", COUNT, "8"]
    said = subprocess.run(run, env=environment("8"), capture_output=True, text=True, check=True)
    assert said.stdout == "1\n"


def threads_below(process: int) -> dict[int, int]:
    """Threads of every process under a process, by its number."""
    found = {}
    waiting = [process]
    while waiting:
        number = waiting.pop()
        try:
            found[number] = len(os.listdir(f"/proc/{number}/task"))
            for task in os.listdir(f"/proc/{number}/task"):
                with open(f"/proc/{number}/task/{task}/children", encoding="ascii") as children:
                    waiting += [int(child) for child in children.read().split()]
        except OSError:
            continue
    return found


@pytest.mark.skipif(sys.platform != "linux", reason="counts threads in /proc")
def test_a_spectrum_on_three_threads_has_three_that_compute(tmp_path):
    """The command, its supervisor, and three processes; the command waits, and feeds them."""
    row = packing_row(quenched(64, 0.9), Hertz(1.0)) | {"converged": True}
    point = {"n": 64, "phi": 0.9, "stage": "packings"}
    write_block(tmp_path / "packings.nc", compute_block(range(4), lambda number: row, point))
    words = ["spectrum", str(tmp_path / "packings.nc"), "--kt", "1", "--processes", "3"]
    settings = '{"protocol": {"spectrum": {"method": "slicing"}}}'
    script = "import sys\nfrom grainmodes.cli import main\nsys.exit(main())"
    run = [sys.executable, "-c", script, *words, "--settings", settings]
    most: dict[int, int] = {}
    with subprocess.Popen(
        [*run, "-o", str(tmp_path / "spectrum.nc")], env=environment("3")
    ) as command:
        while command.poll() is None:
            below = threads_below(command.pid)
            sharing = {number: count for number, count in below.items() if number != command.pid}
            if len(sharing) == 4:  # the one that shares out, and three
                most = {
                    number: max(count, most.get(number, 0)) for number, count in sharing.items()
                }
            time.sleep(0.002)
    assert command.returncode == 0
    first, *others = [count for _, count in sorted(most.items())]
    assert others == [1, 1, 1]
    assert first <= 3  # waiting for the others, with two threads of the pool
