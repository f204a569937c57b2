"""Reading and writing blocks: a block is a dictionary of arrays.

Writing is atomic (temporary name, then rename) and the bytes depend on nothing but the content, so
that a resumed study ends with the same files as an unbroken one. Every file holds a checksum of its
content, which is compared before a number is used.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from grainmodes.dataset import VARIABLES, checksum
from grainmodes.dataset.causes import why_unreadable, why_unwritable
from grainmodes.dataset.library import LOCK, is_refusal, netCDF4
from grainmodes.dataset.units import laws_of
from grainmodes.runtime.atomic import replaced


class BlockError(Exception):
    """A file that is not a readable block; the message says which file and why."""


@dataclass(frozen=True)
class Block:
    """Arrays by name, and the attributes that say where they come from."""

    variables: dict[str, np.ndarray]
    attributes: dict[str, Any]

    def mapping(self, name: str) -> dict:
        """An attribute that is a dictionary: as made, or as the JSON text that a file holds."""
        value: Any = self.attributes.get(name, {})
        return dict(json.loads(value) if isinstance(value, str) else value)


def content_of(block: Block) -> str:
    """What a file holds, in the words of a message: the output of a stage, or an ensemble."""
    if "n" in block.variables:
        return "an ensemble"
    return str(block.attributes.get("stage", "a file that names no stage"))


def check_file(path: Path) -> None:
    """Check that there is a file to read.

    Raises:
        BlockError: there is none, or a folder, a device or a pipe.
    """
    if path.is_dir():
        raise BlockError(f"{path}: expected a file, got a folder")
    if not path.exists():
        raise BlockError(f"{path}: no such file")
    if not path.is_file():
        raise BlockError(f"{path}: expected a regular file, got a device or a pipe")


@contextmanager
def opened_file(path: str | Path) -> Iterator[netCDF4.Dataset]:
    """A netCDF file to read, after its content was compared with its checksum.

    Raises:
        BlockError: no such file, not a file of this package, or a damaged one.
    """
    path = Path(path)
    check_file(path)
    with LOCK:
        try:
            with netCDF4.Dataset(path) as file:
                _check_content(path, file)
                yield file
        except Exception as error:
            if not is_refusal(error):
                raise
            cause = why_unreadable(path, error)
            raise BlockError(f"{path}: not a readable netCDF file: {cause}") from error


def check_content(path: str | Path) -> None:
    """Compare the content of a file with its checksum, once for every state of the file.

    Raises:
        BlockError: as `opened_file`.
    """
    path = Path(path)
    check_file(path)
    status = path.stat()
    state = (path.resolve(), status.st_ino, status.st_size, status.st_mtime_ns)
    if state not in _CHECKED:
        with opened_file(path):
            _CHECKED.add(state)


_CHECKED: set[tuple] = set()
"""The files that were whole when they were looked at: path, inode, size and time of change."""


def _check_content(path: Path, file: netCDF4.Dataset) -> None:
    if checksum.NAME not in file.ncattrs():
        raise BlockError(
            f"{path}: expected a file with a checksum, got none; another program, or an older "
            f"version, has written it"
        )
    stated, found = file.getncattr(checksum.NAME), checksum.checksum(file)
    if stated != found:
        raise BlockError(f"{path}: damaged or changed: expected the checksum {stated}, got {found}")


def write_block(path: str | Path, block: Block) -> None:
    """Write a block: all of it or nothing.

    `block.variables` maps names of `VARIABLES` to arrays with those dimensions. Attribute values
    are numbers, text, or dictionaries (stored as sorted JSON). The text of the units
    follows from the contact law in the attribute `config`.

    Raises:
        KeyError: a name is not in `VARIABLES`.
        ValueError: two arrays disagree about the length of a dimension, or one has masked values.
        OSError: the file cannot be written; nothing is left under `path`.
    """
    with new_file(path) as file:
        _write(file, block)


@contextmanager
def new_file(path: str | Path) -> Iterator[netCDF4.Dataset]:
    """A netCDF file to write into, which stands under `path` only once it is whole.

    Raises:
        OSError: the file cannot be written; whatever stood under `path` is untouched.
    """
    with replaced(path) as partial, LOCK:
        try:
            with netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
                yield file
            with netCDF4.Dataset(partial, "a") as file:  # closed before: as a reader will see it
                file.setncattr(checksum.NAME, checksum.checksum(file))
        except Exception as error:
            if not is_refusal(error):
                raise
            cause = why_unwritable(partial, error)
            raise OSError(f"{path}: cannot be written: {cause}") from error


def _write(file: netCDF4.Dataset, block: Block) -> None:
    for name, value in sorted(block.attributes.items()):
        file.setncattr(
            name, json.dumps(value, sort_keys=True) if isinstance(value, dict) else value
        )
    laws = laws_of(block.mapping("config"))
    for name, array in block.variables.items():
        row = VARIABLES[name]
        if np.ma.is_masked(array):
            raise ValueError(f"{name}: expected a number in every place, got masked values")
        array = np.asarray(array, dtype=row.dtype)
        for dimension, length in zip(row.dimensions, array.shape, strict=True):
            if dimension not in file.dimensions:
                file.createDimension(dimension, length)
            elif len(file.dimensions[dimension]) != length:
                raise ValueError(
                    f"{name}: expected length {len(file.dimensions[dimension])} of dimension "
                    f"{dimension} as in the variables before it, got {length}"
                )
        compressed: dict[str, Any] = (
            {"zlib": True, "complevel": 1, "shuffle": True} if array.ndim > 1 else {}
        )
        variable = file.createVariable(name, row.dtype, row.dimensions, **compressed)
        variable.units = row.unit.text(laws)
        variable.long_name = row.long_name
        variable[...] = array


def read_block(path: str | Path) -> Block:
    """Read a block whole.

    Raises:
        BlockError: no such file, not netCDF, damaged, or without the `seed` dimension.
    """
    with opened_file(path) as file:
        file.set_auto_mask(False)
        variables = {name: variable[...] for name, variable in file.variables.items()}
        attributes = {name: file.getncattr(name) for name in file.ncattrs()}
    del attributes[checksum.NAME]
    unknown = sorted(set(variables) - set(VARIABLES))
    if unknown:
        raise BlockError(
            f"{path}: unknown variable {', '.join(unknown)}, expected names of docs/data.md"
        )
    if "seed" not in variables:
        raise BlockError(
            f"{path}: expected a block of samples, got a file without the variable 'seed'"
        )
    return Block(variables, attributes)
