"""The stage of quasistatic shear: what it holds, that it resumes, and that failures stay apart."""

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

from example_packings import reference
from grainmodes.cli import main
from grainmodes.dataset.files import Block, read_block, write_block
from grainmodes.ensemble.point import merge_blocks
from grainmodes.kernels.laws import Harmonic, Interaction
from grainmodes.linalg.pinned_factor import FloppyError
from grainmodes.packing.box import PackingError
from grainmodes.packing.contacts import History
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.packing.state import Packing
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.stages.checkpoints import CheckpointFiles, fingerprint
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block
from grainmodes.stages.shear import shear_block

LAW = ContactLaw("harmonic", "elastic", 1.0)
SMALL, LOOSE = "harmonic_n16_phi0.900_seed1", "harmonic_n64_phi0.860_seed2"
CHOICES = Shear(strain=0.1, step=1e-3, min_step=1e-6, lowest_eigenvalue="states")
MAIN = "import sys; from grainmodes.cli import main; sys.exit(main(sys.argv[1:]))"
SETTINGS = {
    "contact_law": {"normal": "harmonic"},
    "protocol": {"shear": {"strain": 0.03, "step": 1e-4, "min_step": 1e-8}},
}


def packings(*some: Packing) -> Block:
    """Harmonic packings as a block of stage `packings`."""
    rows = [packing_row(p, Harmonic(1.0)) | {"converged": True} for p in some]
    point = {"n": some[0].n, "phi": some[0].phi, "stage": "packings"}
    return compute_block(range(len(rows)), rows.__getitem__, point)


@pytest.fixture(scope="module")
def sheared() -> Block:
    """One sample with events, one that is not jammed."""
    packing = reference(LOOSE)[1]
    return shear_block(packings(packing, packing.at(0.5)), LAW, CHOICES)


def test_the_curve_is_there_state_by_state(sheared):
    values = sheared.variables
    count = values["curve_count"][0]
    strain = values["curve_strain"][0]
    assert count == np.isfinite(strain).sum() == np.isfinite(values["curve_energy"][0]).sum()
    assert strain[0] == 0.0
    assert strain[count - 1] == pytest.approx(0.1, abs=1e-12)
    assert np.all(np.diff(strain[:count]) > 0.0)
    assert np.all(values["curve_lowest_eigenvalue"][0, :count] > 0.0)


def test_an_event_can_be_taken_up_from_either_side(sheared):
    values, whole = sheared.variables, reference(LOOSE)[1]
    assert values["event_count"][0] >= 1
    for side in ("before", "after"):
        held = values[f"event_contact_i_{side}"][0, 0] >= 0
        history = History.from_pairs(
            *(values[f"event_{name}_{side}"][0, 0][held] for name in ("contact_i", "contact_j")),
            values[f"event_spring_state_{side}"][0, 0][held],
        )
        state = Packing(
            np.ascontiguousarray(values[f"event_fraction_{side}"][0, 0].T),
            whole.diameter,
            whole.mass,
            whole.box_length,
            float(values[f"event_strain_{side}"][0, 0]),
            history=history,
        )
        interaction = Interaction.from_law(LAW)
        assert max(max_force_and_torque(net_force(state, interaction))) < 1e-14


def test_a_packing_that_is_not_jammed_has_no_curve(sheared):
    values = sheared.variables
    assert values["converged"].tolist() == [1, 1]
    assert values["jammed"].tolist() == [1, 0]
    assert values["curve_count"][1] == values["event_count"][1] == 0
    assert np.isnan(values["curve_strain"][1]).all()


def test_a_sample_that_loses_its_rigidity_keeps_its_curve(monkeypatch):
    """And is not converged."""
    advance, tries = QuasistaticRun.advance, []

    def give_up(run):
        tries.append(run)
        run.failure = FloppyError("the backbone lost its rigidity")
        return len(tries) < 5 and advance(run)

    monkeypatch.setattr(QuasistaticRun, "advance", give_up)
    block = shear_block(packings(reference(SMALL)[1]), LAW, CHOICES)
    assert block.variables["converged"].tolist() == [0]
    assert block.variables["curve_count"].tolist() == [5]
    assert block.attributes["failures"] == {}
    reason = "FloppyError: the backbone lost its rigidity"
    assert block.attributes["not_rigid"] == {"shear": {"0": reason}}


def test_a_run_beside_the_curve_that_ends_early_is_no_run_without_events(monkeypatch):
    advance = QuasistaticRun.advance

    def advance_in_short_steps(run):
        if run.choices.min_step < run.choices.step:
            return advance(run)
        run.failure = ArithmeticError("no balance")
        return False

    monkeypatch.setattr(QuasistaticRun, "advance", advance_in_short_steps)
    brief = replace(CHOICES, strain=3e-3)
    found = shear_block(packings(reference(SMALL)[1]), LAW, brief, coarse_run=True)
    assert found.attributes["failures"]["shear"]["0"] == (
        "coarse run: ArithmeticError: no balance; "
        "first event within 1e-03: ArithmeticError: no balance"
    )
    assert found.variables["converged"].tolist() == [0]


def test_a_point_keeps_curves_and_events_but_no_grains(sheared):
    point = merge_blocks({"shear": Block(sheared.variables, sheared.attributes)})
    assert {"curve_strain", "event_g_before", "change_opened"} <= set(point.variables)
    assert not {"event_fraction_before", "event_displacement"} & set(point.variables)


def command(folder, name: str) -> list[str]:
    words = ["shear", str(folder / "packings.nc"), "--kt", "1", "--settings", json.dumps(SETTINGS)]
    return [*words, "--checkpoint-every", "0.05", "-o", str(folder / name)]


def test_a_killed_shear_goes_on_and_ends_with_the_same_bytes(tmp_path):
    write_block(tmp_path / "packings.nc", packings(reference(LOOSE)[1], reference(LOOSE)[1]))
    assert main(command(tmp_path, "whole.nc")) == 0
    process = subprocess.Popen(
        [sys.executable, "-c", MAIN, *command(tmp_path, "again.nc")],
        stderr=subprocess.DEVNULL,
    )
    while not list(tmp_path.glob(".again.nc.*.checkpoint")) and process.poll() is None:
        time.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert not (tmp_path / "again.nc").exists()
    assert main(command(tmp_path, "again.nc")) == 0
    assert (tmp_path / "again.nc").read_bytes() == (tmp_path / "whole.nc").read_bytes()
    assert not list(tmp_path.glob(".again.nc.*"))


def files(folder, start: tuple, seconds: float = 1.0) -> CheckpointFiles:
    """The checkpoints of a file in a folder."""
    return CheckpointFiles(folder / "x.nc", start, seconds)


def test_a_run_of_other_choices_or_a_broken_file_is_ignored(tmp_path):
    run = QuasistaticRun.from_packing(reference(SMALL)[1], Interaction.from_law(LAW), CHOICES)
    checkpoints = files(tmp_path, (LAW, CHOICES), -1.0)
    checkpoints.load("seed-0")
    checkpoints.save_if_due("seed-0", run)
    assert files(tmp_path, (LAW, CHOICES), 1.0).load("seed-0").state.strain_units == 0
    assert files(tmp_path, (LAW, Shear())).load("seed-0") is None
    (tmp_path / ".x.nc.seed-0.checkpoint").write_bytes(b"nonsense")
    assert files(tmp_path, (LAW, CHOICES)).load("seed-0") is None


def test_a_run_from_another_packing_is_ignored(tmp_path):
    """Packings made anew in another way have the same name and place."""
    one = packings(reference(LOOSE)[1])
    marks = [fingerprint(block) for block in (one, one, packings(reference(LOOSE)[1].at(0.865)))]
    assert marks[0] == marks[1] != marks[2]
    checkpoints = files(tmp_path, (LAW, CHOICES, marks[0]), -1.0)
    checkpoints.load("seed-0")
    checkpoints.save_if_due(
        "seed-0",
        QuasistaticRun.from_packing(reference(SMALL)[1], Interaction.from_law(LAW), CHOICES),
    )
    again = [files(tmp_path, (LAW, CHOICES, mark)).load("seed-0") for mark in marks]
    assert [run is None for run in again] == [False, False, True]


def test_a_line_says_how_far_a_run_is(tmp_path, capsys):
    checkpoints = files(tmp_path, (LAW, CHOICES), -1.0)
    run = checkpoints.load("seed-3") or QuasistaticRun.from_packing(
        reference(SMALL)[1], Interaction.from_law(LAW), CHOICES
    )
    while run.state.strain < 0.005 or not run.restartable:
        run.advance()
    checkpoints.save_if_due("seed-3", run)
    line = capsys.readouterr().err
    pattern = r"seed-3: strain 0\.\d+ of 0\.1, \d+ events, \d+ states per second, \d+ min left\n"
    assert re.fullmatch(pattern, line)


def test_the_block_reads_back(tmp_path, sheared):
    write_block(tmp_path / "shear.nc", sheared)
    back = read_block(tmp_path / "shear.nc")
    assert back.attributes["stage"] == "shear"
    for name, array in sheared.variables.items():
        np.testing.assert_array_equal(back.variables[name], array)


def test_a_shear_without_brackets_stands_beside_it():
    choices = Shear(strain=0.03, step=1e-3, min_step=1e-6)
    one = packings(reference(LOOSE)[1])
    values = shear_block(one, LAW, choices, coarse_run=True).variables
    assert values["coarse_strain"].shape == (1, 31)
    alone = shear_block(one, LAW, Shear(strain=0.03, step=1e-3, min_step=1e-3)).variables
    stress = 0.5 * (alone["curve_stress_xy"] + alone["curve_stress_yx"])
    np.testing.assert_array_equal(values["coarse_stress"], stress)
    width = values["bracket_strain_after"] - values["bracket_strain_before"]
    np.testing.assert_allclose(
        values["bracket_min_step"], choices.step / 10.0 ** np.arange(7)[None]
    )
    known = np.isfinite(width)
    assert known.any()
    np.testing.assert_allclose(width[known], values["bracket_min_step"][known], rtol=1e-6)


def test_the_checks_of_the_first_event_are_there():
    packing = reference(LOOSE)[1]
    choices = replace(CHOICES, strain=0.03, step=1e-4)
    found = shear_block(packings(packing), LAW, choices, coarse_run=True)
    values = {name: array[0] for name, array in found.variables.items()}
    assert 0.0 < values["rate_difference"] < 1e-2
    assert 0.0 <= values["loop_left"] < 1e-2 * values["loop_slide"]
    assert 1e-4 < values["last_path_turn"] < values["last_path_error"] <= 1.0
    assert values["last_path_increment"] < 1e-12


def test_a_check_of_the_first_event_that_fails_leaves_the_curve(monkeypatch):
    def broken(*_):
        raise PackingError("two grains lie at the same place")

    monkeypatch.setattr("grainmodes.stages.shear.history_row", broken)
    packing = reference(LOOSE)[1]
    choices = replace(CHOICES, strain=0.03, step=1e-3)
    found = shear_block(packings(packing), LAW, choices, coarse_run=True)
    lost = found.mapping("failures")["shear"]["0"]
    assert lost == "closed loop: PackingError: two grains lie at the same place"
    assert found.variables["converged"][0] == 0
    assert found.variables["curve_count"][0] > 1
    assert np.isfinite(found.variables["last_path_error"][0])
