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
    ("option", "text", "sentence"),
    [
        ("--seed", str(2**63), f"expected seeds of at most {2**63 - 1}, got {2**63}"),
        ("--seed", str(2**64), f"expected seeds of at most {2**63 - 1}, got {2**64}"),
        ("--seeds", "0-99999999999", "expected at most 10000 seeds, got 100000000000"),
        ("--seed", "²", "seeds '²-²': expected first-last"),
        ("--n", "1_6", "argument --n: expected a whole number, got '1_6'"),
        ("--n", "9" * 5000, "argument --n: expected a whole number, got '9999"),
        ("--phi", "٠.٩", "argument --phi: expected a number, got '٠.٩'"),
        ("--kt", "1_0", "argument --kt: expected a number, got '1_0'"),
        ("--friction-coefficient", "x", "--friction-coefficient: expected a number, got 'x'"),
        ("--settings", '{"a": {"b": 1, "b": 2}}', "every key of an object once, got 'b' twice"),
        ("--settings", "[" * 5000, "argument --settings: expected JSON, got '[[["),
        ("--settings", f'{{"a": {"9" * 5000}}}', "argument --settings: expected JSON, got "),
    ],
)
def test_bad_numbers_are_bad_usage(capsys, tmp_path, option, text, sentence):
    usual = {"--n": "16", "--phi": "0.9", "--kt": "1", "--seed": "0", "-o": str(tmp_path / "p.nc")}
    usual.pop("--seed" if option == "--seeds" else option, None)
    words = [word for pair in (usual | {option: text}).items() for word in pair]
    with pytest.raises(SystemExit) as stop:
        main(["point", *words])
    assert stop.value.code == 2
    last = capsys.readouterr().err.splitlines()[-1]
    assert sentence in last and len(last) < 300
    assert not list(tmp_path.iterdir())


def test_minus_zero_is_zero(tmp_path, study):
    for kt in ("0", "-0.0"):
        words = ["rigidity", str(study / "packings.nc"), "--kt", kt]
        assert main([*words, "-o", str(tmp_path / f"{kt}.nc")]) == 0
    assert (tmp_path / "-0.0.nc").read_bytes() == (tmp_path / "0.nc").read_bytes()


def test_a_packing_just_below_a_checkpoint(tmp_path):
    """Its trajectory ends at the checkpoint before."""
    words = ["point", "--n", "16", "--kt", "1e-4", "--seed", "1", "--settings", COARSE]
    for phi in ("0.8999999999", "0.9"):
        assert main([*words, "--phi", phi, "-o", str(tmp_path / f"{phi}.nc")]) == 0
    near, at = (read_block(tmp_path / f"{phi}.nc") for phi in ("0.8999999999", "0.9"))
    assert near.variables["converged"].all() and near.attributes["phi"] == 0.8999999999
    assert near.variables["pressure"] != at.variables["pressure"]
    assert near.variables["pressure"] == pytest.approx(at.variables["pressure"], rel=0.2)


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
        (["--n", "16", "--phi", "1e999", "--kt", "1"], "--phi: expected a number"),
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
    assert "figure: g_phi: expected one ensemble, got 2 files" in capsys.readouterr().err


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


def run(*words: str, stdout=subprocess.PIPE, **variables: str) -> subprocess.CompletedProcess:
    """`python -m grainmodes` in a process of its own."""
    command = [sys.executable, "-m", "grainmodes", *words]
    environment = os.environ | variables
    return subprocess.run(command, stdout=stdout, stderr=subprocess.PIPE, env=environment)


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("words", [["show", "packings.nc"], ["--help"]])
def test_a_reader_that_has_seen_enough_ends_a_command(study, words, unbuffered):
    """With the status that a shell gives to `cat`."""
    words = [str(study / word) if word.endswith(".nc") else word for word in words]
    read, write = os.pipe()
    os.close(read)
    ended = run(*words, stdout=write, PYTHONUNBUFFERED=unbuffered)
    os.close(write)
    assert (ended.returncode, ended.stderr) == (141, b"")


def test_a_broken_pipe_within_is_no_reader_that_has_seen_enough(monkeypatch, capsys):
    """It is that of a child, such as a worker that was killed."""

    def broken(arguments):
        raise BrokenPipeError(32, "Broken pipe")

    monkeypatch.setattr("grainmodes.cli.show.show", broken)
    assert main(["show", "x.nc"]) == 1
    assert "Broken pipe" in capsys.readouterr().err


@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_output_that_cannot_be_written_is_an_error(study, unbuffered):
    with open("/dev/full", "wb") as full:
        ended = run("show", str(study / "packings.nc"), stdout=full, PYTHONUNBUFFERED=unbuffered)
    assert ended.returncode == 1
    assert len(ended.stderr.splitlines()) == 1 and b"No space left on device" in ended.stderr


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252"])
def test_characters_that_a_terminal_lacks_are_escaped(encoding):
    ended = run("claims", "--reference", PYTHONIOENCODING=encoding)
    assert (ended.returncode, ended.stderr) == (0, b"")
    assert b"\\u03c6" in ended.stdout
    whole = run("claims", "--reference", PYTHONIOENCODING="utf-8").stdout.decode()
    assert ended.stdout == whole.encode(encoding, "backslashreplace")


def test_python_without_docstrings_has_the_same_claims():
    words = ["-m", "grainmodes", "claims", "--reference"]
    made = [
        subprocess.run([sys.executable, *options, *words], capture_output=True, check=True).stdout
        for options in ([], ["-OO"])
    ]
    assert made[0] == made[1] and b"holds" in made[0]


def test_a_command_is_told_once_where_it_has_no_data(capsys):
    assert main(["claims"]) == 1
    said = "grainmodes claims: expected either files or --reference, got neither\n"
    assert capsys.readouterr().err == said


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
