"""Result files as a test needs them: edited on purpose, or damaged as a disk damages them."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from grainmodes.dataset import checksum
from grainmodes.dataset.library import netCDF4


@contextmanager
def edited(path: Path) -> Iterator[netCDF4.Dataset]:
    """A file to change, whose checksum is then that of its new content."""
    with netCDF4.Dataset(path, "a") as file:
        yield file
        file.setncattr(checksum.NAME, checksum.checksum(file))


def flip(path: Path, bit: int) -> None:
    """Turn one bit of a file."""
    content = bytearray(path.read_bytes())
    content[bit // 8] ^= 1 << (bit % 8)
    path.write_bytes(content)
