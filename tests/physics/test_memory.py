"""A sample of 65536 grains that is asked for g alone fits into 2 GB: its jobs, one by one."""

import os
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

from example_packings import BACKENDS
from grainmodes.dataset.files import read_block, write_block
from grainmodes.kernels.laws import Hertz
from grainmodes.parameters.compression import Compression
from grainmodes.protocols.compression.trajectory import Trajectory, place_at_random
from grainmodes.relaxation.frictionless import relax_fire_large_steps
from grainmodes.stages.rows import compute_block, stage_attributes
from grainmodes.stages.trajectory_rows import trajectory_row

N, PHI = 65536, 0.9
LIMIT = 2000.0
"""MB that a job may hold."""

COMMAND = """
import sys
if sys.argv[1] == "superlu": sys.modules["pypardiso"] = None
from grainmodes.cli import main
sys.exit(main(sys.argv[2:]))
"""


@pytest.fixture(scope="module")
def start(tmp_path_factory) -> Path:
    """A checkpoint at φ straight from random placement, in the loose balance of a trajectory."""
    normal, protocol = Hertz(1.0), Compression()
    first = place_at_random(N, 0, normal, protocol).packing.at(PHI)
    loose = relax_fire_large_steps(first, normal, 0.0, protocol.intermediate_balance, 20_000)
    steps = round((PHI - protocol.initial_phi) / protocol.phi_step)
    row = trajectory_row(Trajectory(loose.packing, steps, 0.84, loose.iterations))
    config = {"compression": asdict(protocol), "normal": "hertz"}
    path = tmp_path_factory.mktemp("large") / "checkpoint.nc"
    block = compute_block(
        [0], lambda _: row, stage_attributes("trajectories", config, n=N, phi=PHI)
    )
    write_block(path, block)
    return path


def peak(backend: str, *words: object) -> float:
    """Largest resident memory of a command, in MB (1e6 bytes), with this factorisation."""
    job = subprocess.Popen([sys.executable, "-c", COMMAND, backend, *map(str, words)])
    _, status, used = os.wait4(job.pid, 0)
    job.returncode = os.waitstatus_to_exitcode(status)
    assert job.returncode == 0
    return used.ru_maxrss * 1024 / 1e6


@pytest.mark.slow
@pytest.mark.parametrize("backend", BACKENDS)
def test_a_large_sample_asked_for_g_alone_fits_into_two_gigabytes(start, tmp_path, backend):
    packings, g = tmp_path / "packings.nc", tmp_path / "g.nc"
    packing = peak(backend, "equilibrate", start, "--phi", PHI, "-o", packings)
    answering = peak(backend, "rigidity", packings, "--kt", 1e-4, "-o", g)
    print(f"{backend}: pack {packing:.0f} MB, g {answering:.0f} MB")
    found = read_block(g).variables
    assert found["converged"].all() and np.all(found["g"] > 0.0)
    assert max(packing, answering) < LIMIT
