"""Atomic writes: what may be written, where it goes, and what is left behind."""

import errno
import os
import stat

import pytest

from grainmodes.runtime import atomic
from grainmodes.runtime.atomic import replaced


def write(path, text="new"):
    with replaced(path) as partial:
        partial.write_text(text)


def test_links_are_written_through(tmp_path):
    real, link, chain = (tmp_path / name for name in ("real.txt", "link.txt", "chain.txt"))
    real.write_text("old")
    link.symlink_to("real.txt")
    chain.symlink_to(link)
    write(chain)
    assert real.read_text() == "new"
    assert link.is_symlink() and chain.is_symlink()
    hanging = tmp_path / "hanging.txt"
    hanging.symlink_to(tmp_path / "folder" / "made.txt")
    write(hanging)
    assert (tmp_path / "folder" / "made.txt").read_text() == "new"


def test_only_regular_files_are_replaced(tmp_path):
    pipe, loop = tmp_path / "pipe", tmp_path / "loop"
    os.mkfifo(pipe)
    loop.symlink_to("loop")
    for path, words in (
        (pipe, "expected a regular file, got a device or a pipe"),
        (os.devnull, "expected a regular file, got a device or a pipe"),
        (tmp_path, "got a folder"),
        (loop, "got a link to itself"),
    ):
        with pytest.raises(OSError, match=words):
            write(path)
    assert stat.S_ISFIFO(pipe.stat().st_mode) and loop.is_symlink()
    assert {path.name for path in tmp_path.iterdir()} == {"pipe", "loop"}


def test_the_content_is_on_the_disk_before_its_name(tmp_path, monkeypatch):
    """A power cut after the rename must not leave a name without content."""
    happened = []
    sync, rename = os.fsync, os.replace

    def fsync(descriptor):
        folder = stat.S_ISDIR(os.fstat(descriptor).st_mode)
        happened.append("folder" if folder else "content")
        sync(descriptor)

    monkeypatch.setattr(os, "fsync", fsync)
    monkeypatch.setattr(os, "replace", lambda *names: (happened.append("name"), rename(*names)))
    write(tmp_path / "new.txt")
    assert happened == ["content", "name", "folder"]


def test_a_folder_that_cannot_be_flushed_is_no_failure(tmp_path, monkeypatch):
    def refuse(path):
        raise OSError(errno.EINVAL, "Invalid argument")

    flush = atomic._flush
    monkeypatch.setattr(
        atomic, "_flush", lambda path: refuse(path) if path.is_dir() else flush(path)
    )
    write(tmp_path / "new.txt")
    assert (tmp_path / "new.txt").read_text() == "new"


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EACCES])
def test_the_cause_is_named_with_the_file(tmp_path, number):
    path = tmp_path / "new.txt"
    with pytest.raises(OSError) as caught, replaced(path):
        raise OSError(number, os.strerror(number))
    assert str(caught.value) == f"{path}: cannot be written: {os.strerror(number)}"
    assert not list(tmp_path.iterdir())


def test_an_error_about_another_file_stays_what_it_is(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"other\.txt"), replaced(tmp_path / "new.txt"):
        (tmp_path / "other.txt").read_text()
