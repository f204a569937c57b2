"""Maps of a packing: grains as circles in their periodic box, (x, y) as arrows, ℓ as colour.

A map draws rows with the columns `field_rows.GRAINS` and one field, the columns `prefix`_x,
`prefix`_y and `prefix`_rotation. A grain without numbers, a rattler, is an empty circle.
"""

from __future__ import annotations

import math
from itertools import product
from typing import NamedTuple

import matplotlib.colors
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver

from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import COMPONENTS

COLOURS = matplotlib.colors.LinearSegmentedColormap.from_list(
    "rotation", matplotlib.colormaps["RdBu_r"](np.linspace(0.1, 0.9, 256))
)
"""Red turns counter-clockwise; the dark ends are cut off, so that black arrows stay visible."""

OUTLINED = 1100
"""Grains up to which circles have outlines and are vectors; more would be grey, and megabytes."""


class Scale(NamedTuple):
    """Length in d of an arrow of size 1, size of the arrow shown as key, end of the colours.

    `limit` is 0 where nothing turns.
    """

    length: float
    key: float
    limit: float

    @classmethod
    def of(cls, table: pd.DataFrame, prefixes: tuple[str, ...], arrow: float) -> Scale:
        """The scale on which 19 of 20 arrows are shorter than `arrow`, in d."""
        x, y, rotation = (
            np.concatenate([table[f"{prefix}_{name}"] for prefix in prefixes])
            for name in COMPONENTS
        )
        typical = np.nanquantile(np.hypot(x, y), 0.95)
        limit = np.quantile(np.nan_to_num(np.abs(rotation)), 0.99)
        return cls(arrow / typical, rounded(typical), rounded(limit))


def rounded(value: float) -> float:
    """The number of one digit nearest to a value that is not negative: 0.0437 → 0.04."""
    if value == 0.0:
        return 0.0
    decade = 10.0 ** math.floor(math.log10(value))
    return round(value / decade) * decade


def draw_map(axes: Axes, of: pd.DataFrame, prefix: str, scale: Scale) -> Quiver:
    """Grains, colours, arrows and the box; returns the arrows, for `add_key`."""
    length = of["box_length"].iloc[0]
    draw_discs(axes, of, of[f"{prefix}_rotation"].to_numpy(), scale.limit)
    arrows = axes.quiver(
        *(of[name] for name in ("x", "y", f"{prefix}_x", f"{prefix}_y")),
        pivot="mid",
        angles="xy",
        scale_units="xy",
        scale=1.0 / scale.length,
        units="inches",
        width=0.05 / math.sqrt(length),
        headwidth=3.2,
        headlength=3.6,
        headaxislength=3.2,
        minlength=0.0,
        rasterized=len(of) > OUTLINED,
    )
    axes.set(xlim=(0.0, length), ylim=(0.0, length), aspect="equal", xlabel="$x/d$", ylabel="$y/d$")
    axes.tick_params(direction="out", top=False, right=False, which="both")
    return arrows


def add_key(axes: Axes, arrows: Quiver, scale: Scale, unit: str) -> None:
    """An arrow and its size above the right corner of a map."""
    label = f"{scale.key:g}{unit}"
    axes.quiverkey(arrows, 0.86, 1.05, scale.key, label, labelpos="E", labelsep=0.05)


def draw_discs(axes: Axes, of: pd.DataFrame, rotation: np.ndarray, limit: float) -> None:
    """Every grain as a circle of its colour, and its images that reach into the box.

    A rotation of NaN leaves the circle empty.
    """
    faces = COLOURS(_norm(limit)(rotation))  # NaN is transparent
    place, grain = _with_images(of)
    diameter, outlined = of["diameter"].to_numpy()[grain], len(of) <= OUTLINED
    axes.add_collection(
        EllipseCollection(
            diameter,
            diameter,
            np.zeros(len(grain)),
            units="xy",
            offsets=place,
            offset_transform=axes.transData,
            facecolors=faces[grain],
            edgecolors="0.45" if outlined else "none",
            linewidths=0.3,
            rasterized=not outlined,
        )
    )


def _with_images(of: pd.DataFrame) -> tuple[np.ndarray, np.ndarray]:
    """Places (M, 2) of all grains and images that touch the box, and the row of each (M,)."""
    length, strain = of["box_length"].iloc[0], of["strain"].iloc[0]
    shift = [((a + strain * b) * length, b * length) for a, b in product((0, -1, 1), repeat=2)]
    place = np.concatenate([of[["x", "y"]].to_numpy() + step for step in shift])
    grain = np.tile(np.arange(len(of)), len(shift))
    reach = of["diameter"].to_numpy()[grain, None] / 2
    inside = ((place > -reach) & (place < length + reach)).all(axis=1)
    return place[inside], grain[inside]


def add_colour_bar(figure: Figure, panels: list[Axes], scale: Scale, label: str, **place) -> None:
    """The colour bar of some panels; pointed, as a few rotations lie beyond its ends."""
    if scale.limit == 0.0:
        return
    colours = ScalarMappable(_norm(scale.limit), COLOURS)
    figure.colorbar(colours, ax=panels, label=label, extend="both", pad=0.02, **place)


def _norm(limit: float) -> matplotlib.colors.Normalize:
    """Symmetric about 0, with any ends where nothing turns."""
    return matplotlib.colors.Normalize(-(limit or 1.0), limit or 1.0)


def write_caption(figure: Figure, table: pd.DataFrame, note: str) -> None:
    """Which sample is shown, and how its arrows are to be read, above the figure."""
    n, seed = table["n"].iloc[0], table["seed"].iloc[0]
    parts = [rf"$N = {n}$", rf"$\phi = {appearance.fraction(table['phi'].iloc[0])}$"]
    for column, symbol in (("kt", "k_T / k_N"), ("strain_step", r"\Delta\gamma")):
        values = table[column].unique() if column in table else []
        parts += [
            rf"${symbol} = {appearance.power(value)}$" for value in values if len(values) == 1
        ]
    figure.suptitle(f"{', '.join(parts)}, seed {seed}\n{note}")
