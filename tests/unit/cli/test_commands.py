"""The command line: light where it can be, one sentence where it cannot go on."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import synthetic
from grainmodes.cli import main
from grainmodes.dataset.files import Block, read_block, write_block

HEAVY = ("numba", "xarray", "matplotlib", "scipy", "numpy", "jsonschema")

SMALL = ["--n", "16", "--phi", "0.9"]
COARSE = json.dumps({"protocol": {"compression": {"phi_step": 0.01}}})


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A folder with a checkpoint and packings of two samples of 16 grains."""
    folder = tmp_path_factory.mktemp("study")
    start = ["compress", "--n", "16", "--phi", "0.9", "--seeds", "0-1", "--settings", COARSE]
    assert main([*start, "-o", str(folder / "checkpoint.nc")]) == 0
    pack = ["equilibrate", str(folder / "checkpoint.nc"), "--phi", "0.9", "--settings", COARSE]
    assert main([*pack, "-o", str(folder / "packings.nc")]) == 0
    return folder


def loaded_by(*words: str) -> set[str]:
    """Heavy packages that a command imports."""
    script = (
        "import sys\nfrom grainmodes.cli import main\n"
        "try: main(sys.argv[1:])\nexcept SystemExit: pass\n"
        "print(*sys.modules, file=sys.stderr)"
    )
    run = subprocess.run(
        [sys.executable, "-c", script, *words], capture_output=True, text=True, check=True
    )
    return {name for name in HEAVY if name in run.stderr.split()}


@pytest.mark.parametrize("words", [["--help"], ["point", "--help"], ["--version"], ["equilibrate"]])
def test_help_is_light(words):
    assert loaded_by(*words) == set()


def test_showing_is_light(study):
    assert loaded_by("show", str(study / "packings.nc")) == {"numpy"}


def test_help_names_every_command(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["--help"])
    assert stop.value.code == 0
    text = capsys.readouterr().out
    commands = (
        "compress",
        "equilibrate",
        "rigidity",
        "step-strain",
        "spectrum",
        "fields",
        "claim-diagnostics",
    )
    for name in (*commands, "gather", "cost", "claims"):
        assert f"    {name}" in text


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ([], "required: COMMAND"),
        (["melt"], "invalid choice: 'melt'"),
        (["equilibrate"], "required: start, --phi, -o"),
        (["point", *SMALL, "--kt", "1", "--seed", "x", "-o", "p.nc"], "expected first-last"),
        (["point", *SMALL, "--kt", "1", "--seed", "3-1", "-o", "p.nc"], "expected first-last"),
        (
            ["equilibrate", "x.nc", "--phi", "0.9", "--settings", "{", "-o", "p"],
            "expected JSON, got '{'",
        ),
        (
            ["equilibrate", "x.nc", "--phi", "0.9", "--settings", "[]", "-o", "p"],
            "expected a JSON object such as {}, got '[]'",
        ),
        (["figure", "g_psi", "x.nc", "-o", "g"], "invalid choice: 'g_psi'"),
        (
            ["shear", "x.nc", "--kt", "1", "--checkpoint-every", "0", "-o", "s"],
            "expected a number of seconds above 0, got '0'",
        ),
    ],
)
def test_bad_usage(capsys, words, sentence):
    with pytest.raises(SystemExit) as stop:
        main(words)
    assert stop.value.code == 2
    assert sentence in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--n", "15", "--phi", "0.9", "--kt", "1"], "--n: expected a whole even number"),
        (
            ["--n", "4", "--phi", "0.9", "--kt", "1"],
            "--n: expected at least 8 grains, because at phi = 0.9 ",
        ),
        (["--n", "16", "--phi", "0.5", "--kt", "1"], "--phi: expected a number from 0.8"),
        (["--n", "16", "--phi", "nan", "--kt", "1"], "--phi: expected a number"),
        ([*SMALL, "--kt", "-1"], "--kt: expected a number from 0.0"),
        (
            [*SMALL, "--kt", "1", "--friction-coefficient", "1"],
            "contact_law.friction_coefficient: expected none for the tangential law 'elastic'",
        ),
        (
            [*SMALL, "--kt", "1", "--tangential", "sharp_coulomb"],
            "contact_law.friction_coefficient: expected a number above 0",
        ),
        ([*SMALL, "--kt", "1", "--settings", '{"protocol": {"x": 1}}'], "unknown key 'x'"),
        ([*SMALL, "--kt", "1", "--settings", '{"seed": 1}'], "unknown key 'seed'"),
        (
            [*SMALL, "--kt", "1", "--settings", '{"observables": {"spectrum": "all"}}'],
            "observables.spectrum: expected one of none",
        ),
    ],
)
def test_bad_points_are_refused_in_one_line(capsys, tmp_path, words, sentence):
    output = tmp_path / "point.nc"
    assert main(["point", *words, "--seed", "0", "-o", str(output)]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("grainmodes point: ")
    assert sentence in line
    assert not output.exists()


def test_a_missing_file_is_named(capsys, tmp_path):
    words = ["rigidity", "nowhere.nc", "--kt", "1", "-o", str(tmp_path / "r.nc")]
    assert main(words) == 1
    assert capsys.readouterr().err == "grainmodes rigidity: nowhere.nc: no such file\n"


@pytest.mark.parametrize("command", ["rigidity", "step-strain", "spectrum", "fields"])
def test_a_truncated_file_is_refused(capsys, tmp_path, study, command):
    whole = (study / "packings.nc").read_bytes()
    (tmp_path / "half.nc").write_bytes(whole[: len(whole) // 2])
    words = [command, str(tmp_path / "half.nc"), "--kt", "1", "-o", str(tmp_path / "out.nc")]
    assert main(words) == 1
    assert "half.nc: not a readable netCDF file" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["half.nc"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (
            ["rigidity", "checkpoint.nc", "--kt", "1"],
            "expected packings, got trajectories",
        ),
        (["equilibrate", "packings.nc", "--phi", "0.9"], "expected trajectories, got packings"),
        (["equilibrate", "checkpoint.nc", "--phi", "0.9"], "belong to another compression"),
    ],
)
def test_a_file_of_another_stage_is_refused(capsys, tmp_path, study, words, sentence):
    command, name, *options = words
    path = study / name
    assert main([command, str(path), *options, "-o", str(tmp_path / "out.nc")]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"grainmodes {command}: {path}: ")
    assert sentence in line


def test_packings_out_of_balance_are_refused(capsys, tmp_path, study):
    block = read_block(study / "packings.nc")
    block.variables["fraction"][0, 0, 0] += 2**54
    write_block(tmp_path / "moved.nc", block)
    words = ["rigidity", str(tmp_path / "moved.nc"), "--kt", "1", "-o", str(tmp_path / "r.nc")]
    assert main(words) == 1
    assert "moved.nc: packing of seed 0 is not in force balance" in capsys.readouterr().err


def test_an_unwritable_output_is_refused_before_the_work(capsys, tmp_path):
    (tmp_path / "file").write_text("")
    words = ["point", *SMALL, "--kt", "1", "--seed", "0", "-o"]
    assert main([*words, str(tmp_path / "file" / "point.nc")]) == 1
    assert main([*words, str(tmp_path)]) == 1
    assert len(capsys.readouterr().err.splitlines()) == 2


def test_debugging_shows_where():
    with pytest.raises(Exception, match="no such file"):
        main(["--debug", "show", "nowhere.nc"])


@pytest.mark.parametrize(
    ("command", "names"),
    [
        ("rigidity", {"g", "g_affine", "g_nonaffine_loaded"}),
        ("step-strain", {"g_simulated", "contact_changes"}),
        ("spectrum", {"eigenvalue", "psi_rotational"}),
        ("fields", {"nonaffine_field", "nonaffine_field_simulated", "eigenvector"}),
    ],
)
def test_a_response_is_written(tmp_path, study, command, names):
    output = tmp_path / "new" / "response.nc"
    words = [command, str(study / "packings.nc"), "--kt", "1e-4", "-o", str(output)]
    assert main(words) == 0
    block = read_block(output)
    assert names <= set(block.variables)
    assert float(block.attributes["kt"]) == 1e-4


def test_a_figure_of_fields_and_one_of_two_ensembles(tmp_path, study, capsys):
    fields = tmp_path / "fields.nc"
    words = ["fields", str(study / "packings.nc"), "--kt", "1e-4", "-o", str(fields)]
    assert main(words) == 0
    figure = ["figure", "affine_fields", str(fields), "-o", str(tmp_path / "affine")]
    assert main(figure) == 0
    assert (tmp_path / "affine.csv").exists()
    assert main(["figure", "g_phi", "a.nc", "b.nc", "-o", str(tmp_path / "g")]) == 1
    assert "figure g_phi: expected one ensemble, got 2 files" in capsys.readouterr().err


def test_a_spectrum_of_nothing_is_refused(capsys, tmp_path, study):
    settings = ["--settings", '{"observables": {"spectrum": "none"}}']
    words = ["spectrum", str(study / "packings.nc"), "--kt", "1", *settings]
    assert main([*words, "-o", str(tmp_path / "s.nc")]) == 1
    assert (
        "expected one of counts, binned_averages, eigenvalues, modes, got 'none'"
        in capsys.readouterr().err
    )


def test_a_point_without_files_between(tmp_path, capsys):
    output = tmp_path / "point.nc"
    words = ["point", *SMALL, "--kt", "1e-4", "--seed", "3", "--settings", COARSE]
    assert main([*words, "-o", str(output)]) == 0
    block = read_block(output)
    assert block.variables["seed"].tolist() == [3]
    assert {"g", "g_simulated", "eigenvalue", "pressure"} <= set(block.variables)
    assert main(["show", str(output)]) == 0
    text = capsys.readouterr().out
    for part in ("code_version", "eigenvalue", "k_N d^(1/2)", "converged  1 of 1", "none"):
        assert part in text


def test_showing_tells_failures(tmp_path, capsys):
    path = tmp_path / "block.nc"
    failures = {"rigidity": {"1": "ran out of iterations"}}
    variables = {"seed": np.arange(2), "converged": np.array([1, 0])}
    write_block(path, Block(variables, {"failures": failures}))
    assert main(["show", str(path)]) == 0
    text = capsys.readouterr().out
    assert "converged  1 of 2" in text
    assert "1  ran out of iterations" in text


def test_showing_a_folder_is_refused(tmp_path, capsys):
    assert main(["show", str(tmp_path)]) == 1
    assert f"{tmp_path}: expected a file, got a folder" in capsys.readouterr().err


def test_a_reader_that_has_seen_enough_ends_a_command(study):
    script = "import sys; from grainmodes.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", script, "show", str(study / "packings.nc")]
    read, write = os.pipe()
    os.close(read)
    run = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True)
    os.close(write)
    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.parametrize("command", ["complex-pairs", "spectrum-hessian"])
def test_a_stage_that_needs_friction_is_not_run_without(capsys, tmp_path, study, command):
    words = [command, str(study / "packings.nc"), "--kt", "0", "-o", str(tmp_path / "out.nc")]
    assert main(words) == 1
    assert f"{command}: --kt: expected a number above 0, got 0" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_packings_of_another_normal_law_are_refused(capsys, tmp_path, study):
    words = ["rigidity", str(study / "packings.nc"), "--kt", "1", "-o", str(tmp_path / "g.nc")]
    assert main([*words, "--settings", json.dumps({"contact_law": {"normal": "harmonic"}})]) == 1
    sentence = (
        "packings.nc: contact_law.normal: expected 'hertz', with which these samples were made, "
        "got 'harmonic'"
    )
    assert sentence in capsys.readouterr().err


def test_an_ensemble_instead_of_single_samples_is_named(capsys, tmp_path):
    path = synthetic.ensemble(tmp_path, phis=(0.9,), kts=(1.0,), seeds=1)
    assert main(["figure", "event_states", str(path), "-o", str(tmp_path / "f")]) == 1
    assert "expected event details, got an ensemble" in capsys.readouterr().err
    assert main(["rigidity", str(path), "--kt", "1", "-o", str(tmp_path / "g.nc")]) == 1
    assert "expected packings, got an ensemble" in capsys.readouterr().err


def test_showing_no_netcdf(tmp_path, capsys):
    (tmp_path / "notes.txt").write_text("notes")
    assert main(["show", str(tmp_path / "notes.txt")]) == 1
    assert "notes.txt: not a readable netCDF file" in capsys.readouterr().err
