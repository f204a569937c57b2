"""The stage `release`: what it holds, that it resumes, and samples without an unstable state."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest

from grainmodes.cli import main
from grainmodes.dataset.files import read_block, write_block
from grainmodes.ensemble.point import merge_blocks
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.parameters.release import Release
from grainmodes.protocols.release.release_run import FRAMES, ReleaseRun
from grainmodes.stages.checkpoints import CheckpointFiles
from grainmodes.stages.release import release_block, unstable_state
from released import complex_pairs_block, state

CHOICES = Release(duration=16.0, min_time=0.0, dampings=(1.0, 4.0), n_records=400, spectra=4)
MAIN = "import sys; from grainmodes.cli import main; sys.exit(main(sys.argv[1:]))"


@pytest.fixture(scope="module")
def block():
    return release_block(complex_pairs_block(), state()[1], CHOICES)


def test_the_state_of_the_pairs_is_taken_up_exactly():
    start, _, interaction = state()
    found = unstable_state(complex_pairs_block(), 0, 1)
    assert max(max_force_and_torque(net_force(found.packing, interaction))) < 1e-14
    assert found.residual(interaction) < 1e-12
    np.testing.assert_array_equal(found.packing.fraction, start.packing.fraction)
    assert found.eigenvalue == start.eigenvalue


def test_growth_is_that_of_the_pair_and_three_quarters_of_it_under_as_much_drag(block):
    values = block.variables
    rate = values["release_rate_linear"][0, 1]
    found = values["release_displacement_rate"][0, 1]
    np.testing.assert_allclose(found[0] / rate, 1.0, atol=0.01)
    np.testing.assert_allclose(values["release_damping"][0, 1], rate * np.array([0.0, 1.0, 4.0]))
    np.testing.assert_allclose(
        values["release_rate_damped"][0, 1] / rate, [1, 0.728, 0.032], atol=1e-3
    )
    assert values["release_threshold"][0, 1] == pytest.approx(4.156 * rate, rel=1e-3)
    assert np.isnan(found[1:]).all()
    largest_square = values["release_largest_square"][0, 1]
    assert largest_square[0] > 1e-10 > 1e-11 > largest_square[1] > 1e-16 > largest_square[2]


def test_every_run_is_there_record_by_record(block):
    values = block.variables
    time_ = values["release_time"][0, 1]
    for run in time_:
        known = run[np.isfinite(run)]
        assert known[0] == 0.0 and np.all(np.diff(known) > 0.0)
        assert known[-1] * values["release_rate_linear"][0, 1] == pytest.approx(16.0, rel=1e-2)
    assert values["release_contact_number"][0, 1, 0, 0] == pytest.approx(2 * 118 / 50)
    assert values["release_start_pressure"][0, 1] == values["release_pressure"][0, 1, 0, 0]


def test_spectra_are_those_of_the_state_at_their_times(block):
    values = block.variables
    *growing, last = values["release_spectrum_pairs"][0, 1].tolist()
    # The last state is far from the first, and rounding decides whether it has lost a pair.
    assert growing == [8] * 4 and 6 <= last <= 10
    first = values["release_spectrum_imaginary"][0, 1, 0]
    assert np.all(np.diff(first) < 0.0)
    assert state()[0].eigenvalue.imag == pytest.approx(first[0], rel=1e-9)


def test_the_film_holds_the_spirals_of_the_eigenvector(block):
    values = block.variables
    assert values["release_film"].shape == (2, 2, FRAMES, 50, 3)
    assert values["release_spiral_overlap"][0, 1] == pytest.approx(1.0, abs=1e-6)
    assert values["release_spiral_misfit"][0, 1] < 1e-3
    assert 0.1 < values["release_spiral_opening"][0, 1] < 0.9


def test_a_sample_without_a_pair_says_so(block):
    assert block.variables["release_found"].tolist() == [[0, 1], [0, 0]]
    assert block.variables["converged"].tolist() == [1, 1]
    assert np.isnan(block.variables["release_rate_linear"][1]).all()
    assert json.loads(json.dumps(block.attributes["failures"])) == {}


@pytest.mark.parametrize(
    ("name", "value", "sentence"),
    [
        ("unstable_mode_real", 1.0, "residual"),
        ("unstable_eigenvalue_imag", 1e-12, "expected Im above"),
        ("unstable_eigenvalue_imag", 1e-7, "residual"),
    ],
)
def test_a_pair_that_does_not_belong_to_the_state_is_a_failed_row(name, value, sentence):
    pairs = complex_pairs_block()
    pairs.variables[name][0] = value
    failed = release_block(pairs, state()[1], CHOICES)
    assert failed.variables["converged"].tolist() == [0, 1]
    assert sentence in failed.attributes["failures"]["release"]["0"]


def test_a_state_that_fails_leaves_the_others_of_its_sample():
    pairs = complex_pairs_block()
    for name, array in pairs.variables.items():
        if name.startswith("unstable_"):
            array[0, 0] = array[0, 1]
    pairs.variables["unstable_eigenvalue_imag"][0, 0] = 1e-7
    short = replace(CHOICES, duration=0.5, dampings=(), spectra=0)
    found = release_block(pairs, state()[1], short)
    assert found.variables["release_found"].tolist() == [[0, 1], [0, 0]]
    assert found.variables["converged"].tolist() == [1, 1]
    assert found.attributes["failures"]["release"]["0"].startswith("state 0: ArithmeticError: mode")


def test_a_point_keeps_the_numbers_of_runs_and_no_records(block):
    point = merge_blocks({"release": block})
    assert {"release_rate_linear", "release_displacement_rate"} <= set(point.variables)
    assert not {"release_time", "release_film", "release_contacts_after"} & set(point.variables)


def command(folder, name: str) -> list[str]:
    release = {"duration": 5.0, "min_time": 0.0, "dampings": [1.0], "n_records": 300, "spectra": 3}
    law = {"tangential": "smoothed_coulomb", "friction_coefficient": 10.0}
    settings = json.dumps({"contact_law": law, "protocol": {"release": release}})
    kt = repr(state()[1].kt)
    words = ["release", str(folder / "pairs.nc"), "--kt", kt, "--settings", settings]
    return [*words, "--checkpoint-every", "0.02", "-o", str(folder / name)]


def test_a_killed_release_goes_on_and_ends_with_the_same_bytes(tmp_path):
    write_block(tmp_path / "pairs.nc", complex_pairs_block())
    assert main(command(tmp_path, "whole.nc")) == 0
    process = subprocess.Popen(
        [sys.executable, "-c", MAIN, *command(tmp_path, "again.nc")], stderr=subprocess.DEVNULL
    )
    while not list(tmp_path.glob(".again.nc.*.checkpoint")) and process.poll() is None:
        time.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert not (tmp_path / "again.nc").exists()
    assert main(command(tmp_path, "again.nc")) == 0
    assert (tmp_path / "again.nc").read_bytes() == (tmp_path / "whole.nc").read_bytes()
    assert not list(tmp_path.glob(".again.nc.*"))
    assert read_block(tmp_path / "whole.nc").attributes["stage"] == "release"


def test_a_line_says_how_far_a_run_is(tmp_path, capsys):
    start, law, interaction = state()
    checkpoints = CheckpointFiles(tmp_path / "x.nc", (law, CHOICES), -1.0)
    run = checkpoints.load("seed-0-0") or ReleaseRun.from_state(start, interaction, CHOICES)
    run.advance()
    checkpoints.save_if_due("seed-0-0", run)
    pattern = r"seed-0-0: 1 of \d+ steps, M = .*, \d+ steps per second, \d+ min left\n"
    assert re.fullmatch(pattern, capsys.readouterr().err)
    assert CheckpointFiles(tmp_path / "x.nc", (law, CHOICES), 1.0).load("seed-0-0").steps == 1


def test_other_files_are_refused(tmp_path, capsys):
    pairs = complex_pairs_block()
    pairs.attributes["stage"] = "packings"
    write_block(tmp_path / "pairs.nc", pairs)
    assert main(command(tmp_path, "x.nc")) == 1
    assert "expected complex_pairs, got packings" in capsys.readouterr().err
