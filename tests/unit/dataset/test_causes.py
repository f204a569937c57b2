"""The cause of a refused read or write is named, and file systems without locks work."""

import os
import shutil
import subprocess
import sys

import pytest

import synthetic
from grainmodes.dataset import causes, library
from grainmodes.dataset.files import BlockError, read_block, write_block

SHIM = """
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
int flock(int fd, int operation) { errno = ENOLCK; return -1; }
int fcntl64(int fd, int cmd, ...) {
    extern int fcntl(int, int, ...);
    va_list rest; va_start(rest, cmd); void *third = va_arg(rest, void *); va_end(rest);
    if (cmd == F_SETLK || cmd == F_SETLKW || cmd == F_OFD_SETLK) { errno = ENOLCK; return -1; }
    return fcntl(fd, cmd, third);
}
"""
"""A file system without locks: every lock is refused."""

READ_AND_WRITE = """
import sys
from grainmodes.dataset.files import read_block, write_block
from grainmodes.ensemble import open_ensemble
write_block(sys.argv[2], read_block(sys.argv[1]))
with open_ensemble(sys.argv[3]) as opened:
    print(opened.sizes["seed"])
"""


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A folder with blocks and an ensemble."""
    folder = tmp_path_factory.mktemp("results")
    synthetic.ensemble(folder, phis=(0.9,), kts=(1.0,), seeds=2)
    return folder


@pytest.fixture(scope="module")
def without_locks(tmp_path_factory) -> dict[str, str]:
    """The environment of a process to which the system gives no lock."""
    folder = tmp_path_factory.mktemp("shim")
    (folder / "shim.c").write_text(SHIM)
    command = ["cc", "-shared", "-fPIC", "-o", "shim.so", "shim.c"]
    subprocess.run(command, cwd=folder, check=True)
    silent = {k: v for k, v in os.environ.items() if k != "HDF5_USE_FILE_LOCKING"}
    return silent | {"LD_PRELOAD": str(folder / "shim.so")}


def read_and_write(results, tmp_path, environment, first="") -> subprocess.CompletedProcess:
    files = [results / "16-0.9-1.0-rigidity.nc", tmp_path / "copy.nc", results / "ensemble.nc"]
    command = [sys.executable, "-c", first + READ_AND_WRITE, *files]
    return subprocess.run(command, env=environment, capture_output=True, text=True)


def test_a_file_system_without_locks_is_as_good_as_any(results, tmp_path, without_locks):
    run = read_and_write(results, tmp_path, without_locks)
    assert (run.returncode, run.stdout) == (0, "2\n"), run.stderr


@pytest.mark.parametrize(
    ("wishes", "first"), [({"HDF5_USE_FILE_LOCKING": "TRUE"}, ""), ({}, "import netCDF4")]
)
def test_a_refused_lock_is_called_so(results, tmp_path, without_locks, wishes, first):
    """The user has asked for locks, or has loaded the library first."""
    run = read_and_write(results, tmp_path, without_locks | wishes, first)
    assert "its file system refuses a lock (No locks available)" in run.stderr
    assert "set HDF5_USE_FILE_LOCKING=FALSE before netCDF4 is imported" in run.stderr


HOLD = """
import sys
import netCDF4
file = netCDF4.Dataset(sys.argv[1], "a")
print("held", flush=True)
sys.stdin.read()
"""


def test_a_file_that_another_process_holds_is_read(results, tmp_path, monkeypatch):
    path = tmp_path / "block.nc"
    shutil.copyfile(results / "16-0.9-1.0-rigidity.nc", path)
    command = [sys.executable, "-c", HOLD, path]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    locking = os.environ | {"HDF5_USE_FILE_LOCKING": "TRUE"}
    with subprocess.Popen(command, **pipes, env=locking, text=True) as holder:
        assert holder.stdout.readline() == "held\n"
        assert len(read_block(path).variables["seed"]) == 2
        monkeypatch.setattr(library, "LOCKS_FILES", True)
        said = causes.why_unreadable(path, OSError("HDF error"))
        assert "another process has locked it" in said
        holder.stdin.close()


def test_a_file_that_may_not_be_read(results, monkeypatch):
    def refuse(*arguments, **keywords):
        raise PermissionError(13, "Permission denied")

    path = results / "16-0.9-1.0-rigidity.nc"
    monkeypatch.setattr("pathlib.Path.open", refuse)
    assert causes.why_unreadable(path, OSError("HDF error")) == "Permission denied"


@pytest.mark.parametrize("number", ["ENOSPC", "EDQUOT", "EROFS", "EACCES"])
def test_what_the_disk_says_is_said(tmp_path, monkeypatch, number):
    """The library says "HDF error"; a probe in the same folder has the error of the system."""
    import errno

    code = getattr(errno, number)

    def refuse(*arguments, **keywords):
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr("pathlib.Path.open", refuse)
    said = causes.why_unwritable(tmp_path / "block.nc", RuntimeError("NetCDF: HDF error"))
    assert said == os.strerror(code)


def test_a_block_in_an_unwritable_folder_says_why(tmp_path, results):
    block = read_block(results / "16-0.9-1.0-rigidity.nc")
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="cannot be written: File exists"):
        write_block(tmp_path / "file" / "block.nc", block)


def test_a_text_file_is_no_netcdf_file(tmp_path):
    (tmp_path / "notes.nc").write_text("notes" * 100)
    with pytest.raises(BlockError, match=r"notes\.nc: not a readable netCDF file: it is no netCDF"):
        read_block(tmp_path / "notes.nc")
