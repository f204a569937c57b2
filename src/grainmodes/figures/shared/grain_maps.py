"""Maps of a packing: grains as circles in their periodic box, (x, y) as arrows, ℓ as colour.

A map draws rows with the columns `grain_rows.GRAINS` and the columns `prefix`_x, `prefix`_y and
`prefix`_rotation of one field. A grain without numbers, which is a rattler, is an empty circle.
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

from grainmodes.figures.shared import labels
from grainmodes.figures.shared.grain_rows import COMPONENTS

COLOURS = matplotlib.colors.LinearSegmentedColormap.from_list(
    "rotation", matplotlib.colormaps["RdBu_r"](np.linspace(0.1, 0.9, 256))
)
"""Red turns counter-clockwise; the dark ends are cut off, so that black arrows stay visible."""

MAX_OUTLINED_GRAINS = 1100
"""Number of grains up to which circles have outlines and are vectors; the outlines of more grains
would make the map grey, and the file megabytes large."""


class Scale(NamedTuple):
    """How a map translates a field.

    Attributes:
        length: length in d of an arrow of size 1.
        key: size of the arrow that is shown as key.
        limit: rotation at the ends of the colours; 0 where nothing turns.
    """

    length: float
    key: float
    limit: float

    @classmethod
    def from_fields(cls, table: pd.DataFrame, prefixes: tuple[str, ...], arrow: float) -> Scale:
        """The scale on which 19 of 20 arrows of these fields are shorter than `arrow`, in d."""
        x, y, rotation = (
            np.concatenate([table[f"{prefix}_{name}"] for prefix in prefixes])
            for name in COMPONENTS
        )
        typical = np.nanquantile(np.hypot(x, y), 0.95)
        limit = np.quantile(np.nan_to_num(np.abs(rotation)), 0.99)
        return cls(arrow / typical, one_digit(typical), one_digit(limit))


def one_digit(value: float) -> float:
    """A value that is not negative, rounded to one significant digit: 0.0437 → 0.04."""
    if value == 0.0:
        return 0.0
    decade = 10.0 ** math.floor(math.log10(value))
    return round(value / decade) * decade


def draw_map(axes: Axes, grains: pd.DataFrame, prefix: str, scale: Scale) -> Quiver:
    """Draw grains, colours, arrows and the box; returns the arrows, for `add_key`."""
    draw_discs(axes, grains, grains[f"{prefix}_rotation"].to_numpy(), scale.limit)
    arrows = axes.quiver(
        *(grains[name] for name in ("x", "y", f"{prefix}_x", f"{prefix}_y")),
        pivot="mid",
        angles="xy",
        scale_units="xy",
        scale=1.0 / scale.length,
        units="inches",
        width=0.05 / math.sqrt(grains["box_length"].iloc[0]),
        headwidth=3.2,
        headlength=3.6,
        headaxislength=3.2,
        minlength=0.0,
        rasterized=len(grains) > MAX_OUTLINED_GRAINS,
    )
    frame_box(axes, grains)
    return arrows


def frame_box(axes: Axes, grains: pd.DataFrame) -> None:
    """Let the axes be the frame of the box."""
    length = grains["box_length"].iloc[0]
    axes.set(xlim=(0.0, length), ylim=(0.0, length), aspect="equal", xlabel="$x/d$", ylabel="$y/d$")
    axes.tick_params(direction="out", top=False, right=False, which="both")


def add_key(axes: Axes, arrows: Quiver, scale: Scale, unit: str) -> None:
    """Draw an arrow and its size above the right corner of a map."""
    label = f"{scale.key:g}{unit}"
    axes.quiverkey(arrows, 0.86, 1.05, scale.key, label, labelpos="E", labelsep=0.05)


def draw_discs(axes: Axes, grains: pd.DataFrame, rotation: np.ndarray, limit: float) -> None:
    """Draw every grain as a circle of its colour, and its images that reach into the box.

    A rotation of NaN leaves the circle empty.
    """
    faces = COLOURS(_colour_range(limit)(rotation))  # NaN is transparent
    centre, grain = _with_images(grains)
    diameter = grains["diameter"].to_numpy()[grain]
    outlined = len(grains) <= MAX_OUTLINED_GRAINS
    axes.add_collection(
        EllipseCollection(
            diameter,
            diameter,
            np.zeros(len(grain)),
            units="xy",
            offsets=centre,
            offset_transform=axes.transData,
            facecolors=faces[grain],
            edgecolors="0.45" if outlined else "none",
            linewidths=0.3,
            rasterized=not outlined,
        )
    )


def _with_images(grains: pd.DataFrame) -> tuple[np.ndarray, np.ndarray]:
    """Centres (M, 2) of all grains and images that touch the box, and the row of each (M,)."""
    length, strain = grains["box_length"].iloc[0], grains["strain"].iloc[0]
    shifts = [((a + strain * b) * length, b * length) for a, b in product((0, -1, 1), repeat=2)]
    centre = np.concatenate([grains[["x", "y"]].to_numpy() + shift for shift in shifts])
    grain = np.tile(np.arange(len(grains)), len(shifts))
    radius = grains["diameter"].to_numpy()[grain, None] / 2
    inside = ((centre > -radius) & (centre < length + radius)).all(axis=1)
    return centre[inside], grain[inside]


def add_colour_bar(figure: Figure, panels: list[Axes], scale: Scale, label: str, **place) -> None:
    """Add the colour bar of some panels; its ends are pointed, as a few rotations lie beyond."""
    if scale.limit == 0.0:
        return
    colours = ScalarMappable(_colour_range(scale.limit), COLOURS)
    figure.colorbar(colours, ax=panels, label=label, extend="both", pad=0.02, **place)


def _colour_range(limit: float) -> matplotlib.colors.Normalize:
    """Symmetric about 0, with any ends where nothing turns."""
    return matplotlib.colors.Normalize(-(limit or 1.0), limit or 1.0)


def write_map_caption(figure: Figure, table: pd.DataFrame, note: str) -> None:
    """Write above the figure which sample is shown, and how its arrows are to be read.

    k_T and the size of the step strain are stated where all maps share them.
    """
    parts = labels.constants(table, ("n", "phi"))
    if table["kt"].nunique() == 1:
        parts += labels.constants(table, ("kt",))
    if "strain_step" in table:
        parts.append(rf"$\Delta\gamma = {labels.power(table['strain_step'].iloc[0])}$")
    figure.suptitle(f"{', '.join(parts)}, seed {table['seed'].iloc[0]}\n{note}")
