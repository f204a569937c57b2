"""The same seed is the same packing, whatever the processor and its vector unit.

FIRE and the damped dynamics give the same bits everywhere. Newton's method, which finishes a
packing, solves with a library that does not: its last digits may differ, and nothing else.
"""

import json
import os
import subprocess
import sys
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

import trajectories

DIGESTS = {
    "hertz 64": "88e15b9bbdb7409a",
    "hertz 64 elastic": "63c0fd681811c613",
    "hertz 64 smoothed_coulomb": "454711f1d8da5580",
    "harmonic 64": "1bce92eddfede072",
    "hertz 256": "2a10b1d144efaafb",
    "hertz 256 elastic": "e8e456416c89f183",
    "hertz 256 smoothed_coulomb": "3237b2b7a49482bb",
    "hertz 1024": "52405c16ecd7b428",
    "hertz 1024 elastic": "e0bd5d691dd2d502",
    "hertz 1024 smoothed_coulomb": "1edbaacb0168b064",
    "hertz 64 smoothed_coulomb, compressed": "baac73f6a9998e61",
    "harmonic 64 elastic, compressed": "24eaccf405f7cb5f",
}
"""First digits of the SHA-256 of every trajectory, on any machine."""

PROCESSORS = {
    # NUMBA_CPU_NAME; kernels of OpenBLAS, which Newton's method meets
    "x86-64": "Prescott",
    "x86-64-v2": "Nehalem",
    "x86-64-v3": "Haswell",
    None: None,
}
"""Instruction sets to compile for; None is the machine's own."""


@pytest.fixture(scope="module")
def on_this_machine(tmp_path_factory):
    file = tmp_path_factory.mktemp("trajectories") / "host.npz"
    trajectories.main(str(file))
    return np.load(file)


def test_trajectories_have_the_bits_of_every_other_machine(on_this_machine):
    found = json.loads(str(on_this_machine["digest"]))
    assert {case: digest[:16] for case, digest in found.items()} == DIGESTS


@pytest.mark.slow
def test_packings_are_the_same_on_four_instruction_sets(tmp_path):
    found = {name: run_on(name, tmp_path / f"{name}.npz") for name in PROCESSORS}
    for one, other in combinations(found.values(), 2):
        assert str(one["digest"]) == str(other["digest"])
        for n, normal in trajectories.CASES:
            case = f"{normal} {n}"
            np.testing.assert_array_equal(one[f"i/{case}"], other[f"i/{case}"])
            np.testing.assert_array_equal(one[f"j/{case}"], other[f"j/{case}"])
            difference = one[f"fraction/{case}"] - other[f"fraction/{case}"]
            moved = np.abs(difference).max() * 2.0**-64 * one[f"box_length/{case}"]
            assert moved < 1e-13


def run_on(processor: str | None, file: Path):
    """The trajectories, computed by a process that compiles for one instruction set."""
    environment = dict(os.environ)
    if processor is not None:
        environment |= {"NUMBA_CPU_NAME": processor, "NUMBA_CPU_FEATURES": ""}
        environment |= {"OPENBLAS_CORETYPE": PROCESSORS[processor]}
    subprocess.run([sys.executable, trajectories.__file__, str(file)], env=environment, check=True)
    return np.load(file)
