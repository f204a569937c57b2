"""Where a command may write: nothing that is read, or that is no file, is ever overwritten."""

import os
import stat
from pathlib import Path

import numpy as np
import pytest

import synthetic
from grainmodes.cli import main
from grainmodes.cli.arguments import parser
from grainmodes.cli.outputs import outputs_of
from grainmodes.dataset.files import read_block


@pytest.fixture(scope="module")
def point(tmp_path_factory):
    """A folder with the files of a point and of an ensemble."""
    folder = tmp_path_factory.mktemp("point")
    synthetic.ensemble(folder, phis=(0.9,), kts=(1.0,), seeds=2)
    return folder


def refused(capsys, *words) -> str:
    """The sentence with which a command refuses."""
    assert main([str(word) for word in words]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    return line


@pytest.mark.parametrize("kind", ["itself", "symbolic link", "hard link", "longer path"])
def test_an_input_is_not_overwritten(point, tmp_path, capsys, kind):
    given = point / "16-0.9-1.0-packings.nc"
    before = given.read_bytes()
    output = tmp_path / "out.nc"
    if kind == "symbolic link":
        output.symlink_to(given)
    elif kind == "hard link":
        output.hardlink_to(given)
    else:
        output = given if kind == "itself" else point / ".." / point.name / given.name
    for words in (["rigidity", given, "--kt", 1], ["gather", point / "ensemble.nc", given]):
        line = refused(capsys, *words, "-o", output)
        assert f"{output}: cannot be written, the command reads it as {given}" in line
    assert given.read_bytes() == before


def test_a_device_is_not_replaced(point, capsys):
    line = refused(capsys, "gather", point / "16-0.9-1.0-packings.nc", "-o", os.devnull)
    assert f"{os.devnull}: cannot be written, expected a regular file" in line
    assert stat.S_ISCHR(os.stat(os.devnull).st_mode)


def test_a_link_is_written_through(point, tmp_path):
    real, link = tmp_path / "real.nc", tmp_path / "link.nc"
    real.touch()
    link.symlink_to("real.nc")
    blocks = [str(point / f"16-0.9-1.0-{stage}.nc") for stage in ("packings", "rigidity")]
    assert main(["gather", *blocks, "-o", str(link)]) == 0
    assert link.is_symlink()
    np.testing.assert_array_equal(read_block(real).variables["seed"], [0, 1])


def test_a_figure_does_not_overwrite_its_ensemble(point, tmp_path, capsys):
    (tmp_path / "g.csv").symlink_to(point / "ensemble.nc")
    line = refused(capsys, "figure", "g_phi", point / "ensemble.nc", "-o", tmp_path / "g")
    assert "g.csv: cannot be written, the command reads it" in line


@pytest.mark.parametrize("name", ["f", "f.png", "f.txt"])
def test_a_suffix_is_written_once(point, tmp_path, name):
    ensemble = str(point / "ensemble.nc")
    assert main(["figure", "g_phi", ensemble, "-o", str(tmp_path / name)]) == 0
    assert {path.name for path in tmp_path.iterdir()} == {"f.png", "f.pdf", "f.csv", "f.txt"}


def test_two_outputs_are_two_files(point, tmp_path, capsys):
    page = tmp_path / "claims.md"
    line = refused(capsys, "claims", point / "ensemble.nc", "-o", page, page)
    assert "expected every output once" in line
    assert not page.exists()


def test_what_a_command_writes():
    words = ["figure", "g_phi", "e.nc", "-o", "g"]
    assert outputs_of(parser().parse_args(words))[0] == Path("g.png")
    words = ["claims", "e.nc", "-o", "a.md", "b.csv"]
    assert [path.name for path in outputs_of(parser().parse_args(words))] == ["a.md", "b.csv"]
