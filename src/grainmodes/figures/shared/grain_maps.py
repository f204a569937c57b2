"""Maps of a packing: grains as circles in their periodic box, (x, y) as arrows, ℓ as colour.

A map draws rows with the columns `grain_rows.GRAINS` and the columns `prefix`_x, `prefix`_y and
`prefix`_rotation of one field. A grain without numbers, which is a rattler, is an empty circle.
"""

from __future__ import annotations

import math
from itertools import product

import matplotlib.colors
import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from matplotlib.offsetbox import AnchoredOffsetbox, AuxTransformBox, HPacker, TextArea
from matplotlib.patches import FancyArrow
from matplotlib.quiver import Quiver
from matplotlib.ticker import FuncFormatter

from grainmodes.figures.shared import labels
from grainmodes.figures.shared.map_scale import Scale, arrow_spacing, grains_with_arrows

COLOURS = matplotlib.colors.LinearSegmentedColormap.from_list(
    "rotation", matplotlib.colormaps["RdBu_r"](np.linspace(0.1, 0.9, 256))
)
"""Red turns counter-clockwise; the dark ends are cut off, so that black arrows stay visible."""

MAX_OUTLINED_GRAINS = 1100
"""Number of grains up to which circles have outlines and are vectors; the outlines of more grains
would make the map grey, and the file megabytes large."""


def draw_map(axes: Axes, grains: pd.DataFrame, prefix: str, scale: Scale) -> Quiver:
    """Draw grains, colours, arrows and the box; of many grains not each has an arrow."""
    draw_discs(axes, grains, grains[f"{prefix}_rotation"].to_numpy(), scale)
    shown = grains_with_arrows(grains)
    x, y = (shown[f"{prefix}_{name}"].to_numpy() for name in ("x", "y"))
    size = np.hypot(x, y)
    stretch = scale.lengths(size) / np.where(size > 0.0, size, 1.0)
    arrows = axes.quiver(
        shown["x"],
        shown["y"],
        stretch * x,
        stretch * y,
        pivot="mid",
        angles="xy",
        scale_units="xy",
        scale=1.0,
        units="inches",
        width=0.05 / math.sqrt(grains["box_length"].iloc[0] / arrow_spacing(grains)),
        headwidth=3.2,
        headlength=3.6,
        headaxislength=3.2,
        minlength=0.0,
    )
    frame_box(axes, grains)
    return arrows


def frame_box(axes: Axes, grains: pd.DataFrame) -> None:
    """Let the axes be the frame of the box."""
    length = grains["box_length"].iloc[0]
    axes.set(xlim=(0.0, length), ylim=(0.0, length), aspect="equal", xlabel="$x/d$", ylabel="$y/d$")
    axes.tick_params(direction="out", top=False, right=False, which="both")


def add_keys(axes: Axes, scale: Scale, unit: str) -> None:
    """Draw arrows of the sizes of the keys, with these sizes, above the right corner of a map."""
    parts: list[Artist] = []
    for size in scale.keys:
        words = f"${labels.power(size)}${unit}"
        parts += [_key_arrow(axes, scale, size), TextArea(words, textprops={"fontsize": 8})]
    row = HPacker(children=parts, align="center", pad=0.0, sep=3.0)
    axes.add_artist(
        AnchoredOffsetbox(
            "lower right",
            child=row,
            pad=0.2,
            frameon=False,
            bbox_to_anchor=(1.0, 1.0),
            bbox_transform=axes.transAxes,
        )
    )


def _key_arrow(axes: Axes, scale: Scale, size: float) -> AuxTransformBox:
    """An arrow as long as the map draws this size."""
    length, side = scale.lengths(np.array(size)).item(), axes.get_xlim()[1]
    box = AuxTransformBox(axes.transData)
    arrow = FancyArrow(
        0.0,
        0.0,
        length,
        0.0,
        width=0.007 * side,
        head_width=0.022 * side,
        head_length=min(0.025 * side, length),
        length_includes_head=True,
        color="k",
        lw=0.0,
    )
    box.add_artist(arrow)
    return box


def draw_discs(
    axes: Axes, grains: pd.DataFrame, rotation: np.ndarray, scale: Scale | None = None
) -> None:
    """Draw every grain as a circle of its colour, and its images that reach into the box.

    A rotation of NaN leaves the circle empty.

    Args:
        scale: may be absent where every rotation is NaN.
    """
    place = scale.colour_range()(rotation) if scale else rotation
    faces = COLOURS(place)  # NaN is transparent
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
    """Add the colour bar of some panels; its ends are pointed where rotations may lie beyond."""
    if scale.limit == 0.0:
        return
    colours = ScalarMappable(scale.colour_range(), COLOURS)
    place = {"pad": 0.02, "extend": "both" if math.isinf(scale.linear_share) else "neither"} | place
    bar = figure.colorbar(colours, ax=panels, label=label, ticks=scale.colour_ticks(), **place)
    if scale.colour_ticks():
        bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"${_signed(value)}$"))
        bar.minorticks_off()


def _signed(value: float) -> str:
    return f"-{labels.power(-value)}" if value < 0.0 else labels.power(value)


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
