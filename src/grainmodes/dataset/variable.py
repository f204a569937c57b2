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


NOT_GATHERED = {
    *("grain", "contact", "contact_before", "contact_after", "binary_before", "binary_after"),
    *("frame", "record", "spectrum", "pair", "path_state", "spectrum_of_pair"),
}
"""Dimensions of what stays in the files of a stage: grains, contacts, moments of a run."""


def is_gathered(variable: Variable) -> bool:
    """Whether a point keeps it: some numbers per sample, or a series per sample."""
    first, *rest = variable.dimensions or ("",)
    return first == "seed" and not NOT_GATHERED & set(rest)
