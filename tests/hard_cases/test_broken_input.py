"""NaN in a number of one sample at every stage, and a disk that fills up during a write.

The other sample of the block must not notice: its row stays the same to the last bit.
"""

import subprocess
import sys
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

from example_packings import MINIMAL, elastic, reference
from grainmodes.dataset.files import Block, BlockError, read_block
from grainmodes.kernels.laws import Hertz
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.release import Release
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.parameters.strain import Shear, StepStrain
from grainmodes.stages.claim_diagnostics import claim_diagnostics_block
from grainmodes.stages.complex_pairs import complex_pairs_block
from grainmodes.stages.compression import compress_block, packing_block
from grainmodes.stages.event_detail import event_detail_block
from grainmodes.stages.fields import fields_block
from grainmodes.stages.law_comparison import law_comparison_block
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.release import release_block
from grainmodes.stages.rigidity import rigidity_block
from grainmodes.stages.rows import compute_block
from grainmodes.stages.shear import shear_block
from grainmodes.stages.spectrum import hessian_block, rattlers_block, spectrum_block
from grainmodes.stages.step_strain import step_strain_block
from released import complex_pairs_block as unstable_states
from released import state

WEAK, SLIPPING = ContactLaw(kt=1e-2), ContactLaw("hertz", "smoothed_coulomb", 2 / 7, 10.0)
COARSE, SHEAR = Compression(phi_step=1e-2), Shear(2e-3, 1e-3, 1e-4)
SHORT = Release(duration=0.01, min_time=0.0, n_records=60, dampings=(), spectra=0)
MODES = SpectrumChoices()


@cache
def packings() -> Block:
    rows = [
        packing_row(reference(MINIMAL[0])[1], Hertz(1.0)) | {"converged": True} for _ in range(2)
    ]
    return compute_block(range(2), rows.__getitem__, {"n": 16, "phi": 0.9, "stage": "packings"})


@cache
def checkpoints() -> Block:
    return compress_block(16, range(2), 0.7, COARSE, "hertz", None)


@cache
def unstable() -> Block:
    """Two samples that met the same unstable state."""
    block = unstable_states()
    rows = {name: array[[0, 0]] for name, array in block.variables.items()}
    found = {name: array[:, 1:] for name, array in rows.items() if name.startswith("unstable_")}
    rows |= found
    return Block(rows | {"seed": np.arange(2)}, block.attributes)


class Stage(NamedTuple):
    """What a stage starts from, its function, and the names of the numbers that it needs."""

    start: object
    made: object
    needed: tuple[str, ...]


GRAINS = ("diameter", "mass", "box_length", "strain")
STATE = (
    "unstable_strain",
    "unstable_rotation",
    "unstable_spring_state",
    "unstable_eigenvalue_real",
    "unstable_eigenvalue_imag",
    "unstable_mode_real",
    "unstable_mode_imag",
)


HANDED_ON = "unstable_path_"
"""Beginning of names whose numbers `release` hands on as they are; they may be NaN."""


def of_packings(made) -> Stage:
    return Stage(packings, made, GRAINS)


STAGES = {
    "compress": Stage(
        checkpoints,
        lambda block: compress_block(16, range(2), 0.71, COARSE, "hertz", block),
        (*GRAINS, "phi_jamming"),
    ),
    "equilibrate": Stage(
        checkpoints,
        lambda block: packing_block(block, 0.71, COARSE, "hertz"),
        (*GRAINS, "phi_jamming"),
    ),
    "rigidity": of_packings(lambda block: rigidity_block(block, WEAK, Rattlers())),
    "step strain": of_packings(
        lambda block: step_strain_block(block, WEAK, Rattlers(), StepStrain())
    ),
    "spectrum": of_packings(lambda block: spectrum_block(block, WEAK, Rattlers(), "modes", MODES)),
    "rattlers": of_packings(lambda block: rattlers_block(block, WEAK, "modes", MODES)),
    "hessian": of_packings(lambda block: hessian_block(block, WEAK, Rattlers(), MODES)),
    "claim_diagnostics": of_packings(
        lambda block: claim_diagnostics_block(block, ContactLaw(), Rattlers(), StepStrain())
    ),
    "fields": of_packings(lambda block: fields_block(block, WEAK, Rattlers(), StepStrain())),
    "event-detail": of_packings(lambda block: event_detail_block(block, WEAK, SHEAR)),
    "shear": of_packings(lambda block: shear_block(block, WEAK, SHEAR)),
    "pairs": of_packings(lambda block: complex_pairs_block(block, SLIPPING, SHEAR, PairChoices())),
    "law_comparison": of_packings(lambda block: law_comparison_block(block, SLIPPING, SHEAR)),
    "release": Stage(
        unstable, lambda block: release_block(block, state()[1], SHORT), (*GRAINS[:3], *STATE)
    ),
}
"""Every stage that computes."""


@cache
def sound(stage: str) -> Block:
    return STAGES[stage].made(STAGES[stage].start())


def infected(block: Block, name: str) -> Block:
    """The block with one number of its first sample not a number."""
    array = block.variables[name].copy()
    array[(0,) * array.ndim] = np.nan
    return Block(block.variables | {name: array}, block.attributes)


@pytest.mark.parametrize("stage", STAGES)
def test_what_is_no_number_fails_its_sample_and_no_other(stage):
    start, expected = STAGES[stage].start(), sound(stage)
    assert expected.variables["converged"].all() and expected.attributes["failures"] == {}
    for name in STAGES[stage].needed:
        found = STAGES[stage].made(infected(start, name))
        assert found.variables["converged"][0] == 0, name
        (reasons,) = found.attributes["failures"].values()
        assert "nan" in reasons["0"], name
        for each, array in found.variables.items():
            np.testing.assert_array_equal(array[1:], expected.variables[each][1:], err_msg=name)


@pytest.mark.parametrize("stage", STAGES)
def test_numbers_that_a_stage_does_not_need_may_be_none(stage):
    start, expected = STAGES[stage].start(), sound(stage)
    others = set(start.variables) - set(STAGES[stage].needed)
    numbers = [name for name in sorted(others) if start.variables[name].dtype.kind == "f"]
    for name in numbers:
        if name.startswith(HANDED_ON):
            continue
        found = STAGES[stage].made(infected(start, name))
        for each, array in expected.variables.items():
            np.testing.assert_array_equal(found.variables[each], array, err_msg=name)


@pytest.mark.parametrize("name", ["box_length", "strain"])
def test_a_packing_without_a_number_looks_unjammed(name):
    """Nothing compares with NaN: no contact, no force, max|F| = 0 < F_Th, and so g = 0."""
    packing = replace(reference(MINIMAL[0])[1], **{name: np.nan})
    contacts = packing.contacts
    assert len(contacts.i) == 0
    assert max_force_and_torque(net_force(packing, elastic("hertz", 1.0))) == (0.0, 0.0)
    with pytest.raises(ValueError, match=f"{name}: expected a finite number, got nan"):
        packing.checked()


COMMAND = """
import resource, signal, sys
import netCDF4
from grainmodes.cli import main
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]),) * 2)
try:
    with netCDF4.Dataset(sys.argv[2], "w") as file:
        file.createDimension("seed", 10_000)
        file.createVariable("g", "f8", ("seed",))[:] = 1.0
except (OSError, RuntimeError):
    pass
sys.exit(main(sys.argv[3:]))
"""


@pytest.mark.parametrize("room", [0, 10_000])
def test_a_full_disk_is_told_in_one_line_and_leaves_the_old_file(tmp_path, room):
    """A limit on the size of files stands in for the disk; netCDF says `Permission denied` at 0."""
    output, naive = tmp_path / "block.nc", tmp_path / "naive.nc"
    output.write_text("the old one")
    words = f"{room} {naive} compress --n 16 --phi 0.8 --seeds 0-1 -o {output}".split()
    run = subprocess.run([sys.executable, "-c", COMMAND, *words], capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stderr.count("\n") == 1
    assert f"{output}: cannot be written: File too large\n" in run.stderr
    assert output.read_text() == "the old one"
    assert set(tmp_path.iterdir()) == {output, naive}
    with pytest.raises(BlockError):
        read_block(naive)
