"""How a map translates a field: sizes into lengths of arrows, rotations into colours."""

from __future__ import annotations

import math
from typing import NamedTuple

import matplotlib.colors
import numpy as np
import pandas as pd

from grainmodes.figures.shared.grain_rows import COMPONENTS

LINEAR_SHARE = 0.01
"""Share of the largest value up to which a compressed scale is linear."""


MAX_ARROWS = 1100
"""Number of grains up to which each has its arrow."""

ARROWS_PER_SIDE = 24
"""Number of arrows along the box where there are more grains."""


class Scale(NamedTuple):
    """The scale of a map.

    Attributes:
        size: a size of the field in its unit, and
        length: the length in d of the arrow that stands for it.
        keys: sizes whose arrows are shown as keys.
        limit: rotation at the ends of the colours; 0 where nothing turns.
        linear_share: share of `size` and of `limit` up to which lengths and colours are
            proportional to the field; beyond it they grow as its logarithm. Infinite: everywhere.
    """

    size: float
    length: float
    keys: tuple[float, ...]
    limit: float
    linear_share: float = math.inf

    @classmethod
    def from_fields(cls, table: pd.DataFrame, prefixes: tuple[str, ...], arrow: float) -> Scale:
        """The scale on which 19 of 20 arrows of these fields are shorter than `arrow`.

        `arrow` is in units of d, and of the distance of the arrows where a map thins them out.
        """
        sizes, rotations = _sizes(table, prefixes)
        typical = np.nanquantile(sizes, 0.95)
        length = arrow * arrow_spacing(table)
        limit = one_digit(np.quantile(rotations, 0.99))
        return cls(typical, length, (one_digit(typical),), limit)

    @classmethod
    def compressed(cls, table: pd.DataFrame, prefix: str, arrow: float) -> Scale:
        """The scale of a field that spans decades: its largest value has the length `arrow`, in d,
        and its largest rotation the last colour."""
        sizes, rotations = _sizes(table, (prefix,))
        largest = np.nanmax(sizes)
        key = one_digit(largest)
        return cls(largest, arrow, (key, key / 100), rotations.max(), LINEAR_SHARE)

    def lengths(self, sizes: np.ndarray) -> np.ndarray:
        """Lengths in d of the arrows that stand for these sizes."""
        share = sizes / self.size
        if math.isinf(self.linear_share):
            return self.length * share
        return self.length * _compressed(share / self.linear_share, 1.0 / self.linear_share)

    def colour_range(self) -> matplotlib.colors.Normalize:
        """Rotation → place among the colours, symmetric about 0; any ends where nothing turns."""
        limit = self.limit or 1.0
        if math.isinf(self.linear_share):
            return matplotlib.colors.Normalize(-limit, limit)
        width = self.linear_share * limit
        return matplotlib.colors.AsinhNorm(linear_width=width, vmin=-limit, vmax=limit)

    def colour_ticks(self) -> list[float] | None:
        """Values beside the colours: 0 and two decades on either side; None where Matplotlib is to
        choose them."""
        if math.isinf(self.linear_share):
            return None
        decade = 10.0 ** math.floor(math.log10(self.limit))
        return [-decade, -decade / 10.0, 0.0, decade / 10.0, decade]


def _compressed(value: np.ndarray, largest: float) -> np.ndarray:
    """0 to `largest` → 0 to 1: linear up to 1, logarithmic beyond."""
    return np.arcsinh(value) / np.arcsinh(largest)


def _sizes(table: pd.DataFrame, prefixes: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Sizes of the vectors (x, y) and of the rotations of these fields; a rattler does not turn."""
    x, y, rotation = (
        np.concatenate([table[f"{prefix}_{name}"] for prefix in prefixes]) for name in COMPONENTS
    )
    return np.hypot(x, y), np.nan_to_num(np.abs(rotation))


def arrow_spacing(grains: pd.DataFrame) -> float:
    """Distance in d between the arrows of a map: 1 where every grain has its own."""
    if grains["grain"].nunique() <= MAX_ARROWS:
        return 1.0
    return grains["box_length"].iloc[0] / ARROWS_PER_SIDE


def grains_with_arrows(grains: pd.DataFrame) -> pd.DataFrame:
    """The rows whose arrows are drawn: all; of many grains the one nearest to the middle of each
    cell of a square grid."""
    if len(grains) <= MAX_ARROWS:
        return grains
    place = grains[["x", "y"]].to_numpy() / arrow_spacing(grains)
    cell = np.floor(place)
    nearest = np.argsort(((place - cell - 0.5) ** 2).sum(axis=1), kind="stable")
    first = np.unique(cell[nearest], axis=0, return_index=True)[1]
    return grains.iloc[np.sort(nearest[first])]


def arrow_note(grains: pd.DataFrame) -> str:
    """What a caption says where not every grain has its arrow."""
    if grains["grain"].nunique() <= MAX_ARROWS:
        return ""
    return f"; one grain in each cell of {ARROWS_PER_SIDE} × {ARROWS_PER_SIDE} has its arrow"


def one_digit(value: float) -> float:
    """A value that is not negative, rounded to one significant digit: 0.0437 → 0.04."""
    if value == 0.0:
        return 0.0
    decade = 10.0 ** math.floor(math.log10(value))
    return round(value / decade) * decade
