"""A row of the table of names, and the dimensions that many rows share."""

from __future__ import annotations

from typing import NamedTuple

from grainmodes.dataset.units import Unit

BLOCK = ("seed",)
MODES = ("seed", "mode")
BINS = ("seed", "bin")


class Variable(NamedTuple):
    """What a name means: its dimensions, the type of its numbers, their unit, and a description."""

    dimensions: tuple[str, ...]
    dtype: str
    unit: Unit
    long_name: str
