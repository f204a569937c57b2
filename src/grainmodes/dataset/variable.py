"""A row of the table of names, and the dimensions and units that many rows share."""

from __future__ import annotations

from typing import NamedTuple

BLOCK = ("seed",)
MODES = ("seed", "mode")
BINS = ("seed", "bin")
FORCE = "k_N d^(3/2)"
MODULUS = "k_N d^(1/2)"


class Variable(NamedTuple):
    """What a name means."""

    dimensions: tuple[str, ...]
    dtype: str
    units: str
    long_name: str
