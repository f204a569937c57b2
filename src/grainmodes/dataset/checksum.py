"""The checksum of a netCDF file: of what it holds, not of how HDF5 lays it out.

It is the SHA-256 of a line of JSON for the attributes of the file, for each dimension and for each
variable (name, type, dimensions, shape, attributes), in the order of the names; behind the line of
a variable follow its numbers in C order, little endian. Copies in another layout (nccopy,
h5repack) have the same checksum.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from grainmodes.dataset.library import netCDF4

NAME = "checksum"
"""The attribute of a file that holds it; it does not belong to what it is made of."""

MAX_VALUES = 2**21
"""Largest number of values that are in memory at a time."""


def checksum(file: netCDF4.Dataset) -> str:
    """The checksum of an open file: "sha256:" and 64 hexadecimal digits."""
    file.set_auto_maskandscale(False)
    digest = hashlib.sha256()
    lines: list[list[Any]] = [["attributes", _attributes(file)]]
    lines += [[name, len(dimension)] for name, dimension in sorted(file.dimensions.items())]
    for line in lines:
        digest.update(json.dumps(line).encode() + b"\n")
    for name, variable in sorted(file.variables.items()):
        dtype = np.dtype(variable.dtype).newbyteorder("<")
        line = [name, dtype.str, variable.dimensions, variable.shape, _attributes(variable)]
        digest.update(json.dumps(line).encode() + b"\n")
        for place in _places(variable.shape):
            digest.update(np.ascontiguousarray(variable[place], dtype).tobytes())
    return f"sha256:{digest.hexdigest()}"


def _attributes(owner: netCDF4.Dataset | netCDF4.Variable) -> list[tuple[str, Any]]:
    """The attributes of a file or a variable as plain values, in the order of the names."""
    names = (name for name in sorted(owner.ncattrs()) if name != NAME)
    return [(name, _plain(owner.getncattr(name))) for name in names]


def _plain(value: Any) -> Any:
    """Text as it is; numbers with their type, shape and bytes."""
    if isinstance(value, str):
        return value
    array = np.asarray(value)
    if array.dtype.kind in "OUS":
        return array.tolist()
    array = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
    return [array.dtype.str, array.shape, array.tobytes().hex()]


def _places(shape: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """Indices of parts of an array that follow one another, each of at most MAX_VALUES values."""
    depth = 0
    while depth < len(shape) and math.prod(shape[depth:]) > MAX_VALUES:
        depth += 1
    return iter(np.ndindex(shape[:depth]))
