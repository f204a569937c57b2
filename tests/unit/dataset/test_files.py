"""Blocks on disk: whole or not at all, the same bytes for the same content."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_array_equal

from grainmodes.dataset import VARIABLES
from grainmodes.dataset.files import Block, BlockError, read_block, write_block

DATA_MD = Path(__file__).parents[3] / "docs" / "data.md"


def block(size=3):
    return Block(
        {
            "seed": np.arange(size),
            "g": np.linspace(0.1, 0.2, size),
            "converged": np.ones(size, dtype=bool),
            "fraction": np.full((size, 4, 2), -(2**63) + 1),
            "eigenvalue": np.linspace(0.0, 1.0, size * 12).reshape(size, 12),
        },
        {"n": 4, "phi": 0.9, "config": {"b": 1, "a": 2}, "failures": {}},
    )


def test_what_is_written_is_read(tmp_path):
    write_block(tmp_path / "block.nc", block())
    found = read_block(tmp_path / "block.nc")
    for name, array in block().variables.items():
        assert_array_equal(found.variables[name], array)
        assert found.variables[name].dtype == VARIABLES[name].dtype
    assert (found.attributes["n"], found.attributes["phi"]) == (4, 0.9)
    assert json.loads(found.attributes["config"]) == {"a": 2, "b": 1}


def test_a_block_opens_with_xarray(tmp_path):
    write_block(tmp_path / "block.nc", block())
    with xr.open_dataset(tmp_path / "block.nc") as dataset:
        assert dataset["g"].attrs["long_name"] == "rigidity under an unloaded step strain"
        assert dataset["eigenvalue"].dims == ("seed", "mode")


HERTZ = {"normal": "hertz", "tangential": "sharp_coulomb_force"}


@pytest.mark.parametrize(
    ("config", "units"),
    [
        ({"normal": "hertz", "law": HERTZ}, ("k_N d^(1/2)", "k_N d^(3/2)")),
        ({"normal": "harmonic"}, ("k_N", "d or k_N d")),
        (
            {"packings": {"normal": "hertz"}, "shear": {"law": HERTZ}},
            ("k_N d^(1/2)", "k_N d^(3/2)"),
        ),
        ({"contact_law": HERTZ | {"tangential": "elastic"}}, ("k_N d^(1/2)", "d")),
        ({"format": "foreign"}, ("f_0 d^-1", "d or f_0")),
    ],
)
def test_units_follow_from_the_contact_law(tmp_path, config, units):
    variables = {"seed": np.arange(2), "g": np.ones(2), "spring_state": np.ones((2, 3))}
    write_block(tmp_path / "block.nc", Block(variables, {"config": config}))
    with xr.open_dataset(tmp_path / "block.nc") as dataset:
        assert (dataset["g"].attrs["units"], dataset["spring_state"].attrs["units"]) == units


def test_same_content_same_bytes(tmp_path):
    write_block(tmp_path / "first.nc", block())
    time.sleep(1.1)
    again = block()
    again.attributes["config"] = dict(reversed(again.attributes["config"].items()))
    write_block(tmp_path / "second.nc", again)
    assert (tmp_path / "first.nc").read_bytes() == (tmp_path / "second.nc").read_bytes()


def test_a_block_that_cannot_be_written_leaves_the_old_one(tmp_path):
    path = tmp_path / "block.nc"
    write_block(path, block())
    before = path.read_bytes()
    with pytest.raises(ValueError, match=r"g: expected length 3 of dimension seed as .* got 2"):
        write_block(path, Block({"seed": np.arange(3), "g": np.zeros(2)}, {}))
    with pytest.raises(KeyError):
        write_block(path, Block({"seed": np.arange(3), "temperature": np.zeros(3)}, {}))
    assert path.read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["block.nc"]


def test_a_full_disk_leaves_nothing(tmp_path):
    """A limit on the size of files stands in for the disk: the write fails half-way."""
    program = f"""
import resource, signal
import numpy as np
from grainmodes.dataset.files import Block, write_block
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
noise = np.random.default_rng(0).random((4, 100_000))
block = Block({{"seed": np.arange(4), "eigenvalue": noise}}, {{}})
try:
    write_block({str(tmp_path / "block.nc")!r}, block)
except OSError:
    print("refused")
"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stdout == "refused\n", run.stderr
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("kept", [0, 10, 1000, -1])
def test_a_truncated_file_is_refused_with_its_name(tmp_path, kept):
    path = tmp_path / "block.nc"
    write_block(path, block())
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(BlockError, match=r"block\.nc: not a readable netCDF file"):
        read_block(path)


def test_what_is_no_block_is_refused(tmp_path):
    with pytest.raises(BlockError, match=r"nothing\.nc: no such file"):
        read_block(tmp_path / "nothing.nc")
    (tmp_path / "text.nc").write_text("not netCDF")
    with pytest.raises(BlockError, match=r"text\.nc: not a readable netCDF file"):
        read_block(tmp_path / "text.nc")
    write_block(tmp_path / "seedless.nc", Block({"phi": np.array([0.9])}, {}))
    with pytest.raises(
        BlockError,
        match=r"seedless\.nc: expected a block of samples, got a file without the variable 'seed'",
    ):
        read_block(tmp_path / "seedless.nc")


def test_the_handbook_follows_from_the_tables():
    script = DATA_MD.parents[1] / "workflow" / "scripts" / "handbook.py"
    run = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    text = DATA_MD.read_text(encoding="utf-8")
    assert all(f"| `{name}` |" in text for name in VARIABLES)


def test_only_coordinates_share_the_name_of_a_dimension():
    """netCDF takes a variable of the name of a dimension for its scale."""
    dimensions = {dimension for row in VARIABLES.values() for dimension in row.dimensions}
    for name in dimensions & set(VARIABLES):
        assert VARIABLES[name].dimensions == (name,)
