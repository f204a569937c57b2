"""No number changes silently: damaged files are refused in one sentence, or read as they were."""

import random
import shutil
import subprocess
import sys

import netCDF4
import numpy as np
import pytest

import synthetic
from edited_files import edited, flip
from grainmodes.cli import main
from grainmodes.dataset import checksum
from grainmodes.dataset.checksum import checksum as of_file
from grainmodes.dataset.files import Block, BlockError, check_content, read_block, write_block
from grainmodes.ensemble import gather_point, open_ensemble


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A folder with blocks, a point and an ensemble."""
    folder = tmp_path_factory.mktemp("results")
    synthetic.ensemble(folder, phis=(0.9,), kts=(1.0,), seeds=2)
    return folder


FILES = ["16-0.9-1.0-packings.nc", "16-0.9-1.0-spectrum.nc", "16-0.9-1.0.nc", "ensemble.nc"]


def content(path) -> str:
    """Everything that a reader sees."""
    with netCDF4.Dataset(path) as file:
        return of_file(file)


@pytest.mark.parametrize("name", FILES)
def test_flipped_bits_are_found_or_change_nothing(results, tmp_path, name):
    whole, path, draws = content(results / name), tmp_path / name, random.Random(17)
    found = 0
    for _ in range(60):
        shutil.copyfile(results / name, path)
        flip(path, draws.randrange(8 * path.stat().st_size))
        try:
            check_content(path)
        except BlockError as error:
            assert str(error).startswith(f"{path}: ") and "\n" not in str(error)
            found += 1
        else:
            assert content(path) == whole
    assert found > 5


@pytest.mark.parametrize("name", FILES)
def test_a_shorter_file_is_found(results, tmp_path, name):
    path, whole = tmp_path / name, (results / name).read_bytes()
    for kept in (0, 10, 63, 64, 1000, len(whole) // 2, len(whole) - 1):
        path.write_bytes(whole[:kept])
        words = "truncated" if kept else "it is empty"
        with pytest.raises(BlockError, match=rf"not a readable netCDF file: {words}"):
            read_block(path)


CHANGES = {
    "a number": lambda file: file["g"].__setitem__(0, 0.5),
    "an attribute": lambda file: file.setncattr("phi", 0.91),
    "the unit of a variable": lambda file: file["g"].setncattr("units", "d"),
    "a further attribute": lambda file: file.setncattr("note", ""),
    "a missing attribute": lambda file: file.delncattr("kt"),
    "the name of a dimension": lambda file: file.renameDimension("seed", "sample"),
    "the name of a variable": lambda file: file.renameVariable("g", "g_loaded_"),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_every_part_of_the_content_counts(results, tmp_path, change):
    path = tmp_path / "block.nc"
    shutil.copyfile(results / "16-0.9-1.0-rigidity.nc", path)
    with netCDF4.Dataset(path, "a") as file:
        change(file)
    with pytest.raises(BlockError, match=rf"{path}: damaged or changed: expected the checksum"):
        read_block(path)
    with edited(path):
        pass
    check_content(path)


def test_another_layout_has_the_same_checksum(results, tmp_path):
    with (
        netCDF4.Dataset(results / "ensemble.nc") as old,
        netCDF4.Dataset(tmp_path / "copy.nc", "w") as new,
    ):
        for name, dimension in reversed(old.dimensions.items()):
            new.createDimension(name, len(dimension))
        new.setncatts({name: old.getncattr(name) for name in reversed(old.ncattrs())})
        for name, variable in reversed(old.variables.items()):
            notes = {key: variable.getncattr(key) for key in variable.ncattrs()}
            fill = notes.pop("_FillValue", None)
            copy = new.createVariable(
                name, variable.dtype, variable.dimensions, fill_value=fill, endian="big"
            )
            copy.setncatts(notes)
            variable.set_auto_maskandscale(False)
            copy[...] = variable[...]
    check_content(tmp_path / "copy.nc")


def test_large_arrays_are_read_in_parts(results, monkeypatch):
    with netCDF4.Dataset(results / "ensemble.nc") as file:
        whole = of_file(file)
        monkeypatch.setattr(checksum, "MAX_VALUES", 3)
        assert of_file(file) == whole


def test_a_file_without_a_checksum_is_refused(results, tmp_path):
    path = tmp_path / "block.nc"
    shutil.copyfile(results / "16-0.9-1.0-rigidity.nc", path)
    with netCDF4.Dataset(path, "a") as file:
        file.delncattr(checksum.NAME)
    with pytest.raises(BlockError, match="expected a file with a checksum, got none"):
        read_block(path)


def test_every_reader_compares(results, tmp_path, capsys):
    with netCDF4.Dataset(results / "ensemble.nc") as file:
        assert file["g"][0, 0, 0, 0] > 0.0
    for name in ("ensemble.nc", "16-0.9-1.0.nc", "16-0.9-1.0-packings.nc"):
        shutil.copyfile(results / name, tmp_path / name)
        with netCDF4.Dataset(tmp_path / name, "a") as file:
            file["pressure"][...] = 1.0
    ensemble, point, packings = (
        str(tmp_path / name) for name in ("ensemble.nc", "16-0.9-1.0.nc", "16-0.9-1.0-packings.nc")
    )
    out = ["-o", str(tmp_path / "out")]
    for words in (
        ["show", ensemble],
        ["show", point],
        ["figure", "g_phi", ensemble, *out],
        ["claims", ensemble],
        ["plan", ensemble, "--target-error", "1%"],
        ["ensemble", point, *out],
        ["gather", packings, *out],
        ["rigidity", packings, "--kt", "1", *out],
    ):
        assert main(words) == 1, words
        (line,) = capsys.readouterr().err.splitlines()
        assert "damaged or changed: expected the checksum" in line
    for read in (open_ensemble, read_block, lambda path: gather_point([path])):
        with pytest.raises(BlockError, match="damaged or changed"):
            read(ensemble)


def test_masked_values_are_refused(tmp_path):
    masked = np.ma.masked_array([0.1, 0.2], mask=[False, True])
    block = Block({"seed": np.arange(2), "g": masked}, {})
    with pytest.raises(ValueError, match="g: expected a number in every place, got masked values"):
        write_block(tmp_path / "block.nc", block)
    assert not list(tmp_path.iterdir())


THREADS = """
import sys
from concurrent.futures import ThreadPoolExecutor
from grainmodes.dataset.files import read_block, write_block
from grainmodes.ensemble import open_ensemble
block, ensemble, folder = sys.argv[1:]
def work(number):
    made = read_block(block)
    write_block(f"{folder}/{number}.nc", made)
    with open_ensemble(ensemble) as opened:
        return float(opened["g"].sum())
with ThreadPoolExecutor(8) as pool:
    print(len(set(pool.map(work, range(60)))))
"""


def test_threads_share_the_library(results, tmp_path):
    files = [results / "16-0.9-1.0-spectrum.nc", results / "ensemble.nc", tmp_path]
    run = subprocess.run([sys.executable, "-c", THREADS, *files], capture_output=True, text=True)
    assert (run.returncode, run.stdout) == (0, "1\n"), run.stderr[-2000:]
