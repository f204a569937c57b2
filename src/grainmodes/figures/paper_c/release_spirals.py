"""Trajectories of the grains while a released pair grows are spirals, C (13), (28): C, Fig. 5.

Left all grains, as circles at the start, with their trajectories; right three trajectories that
enclose the largest area. Lines go from light to dark in time, and displacements are drawn larger
than they are, by the factor of the caption.

Where ω_i is much smaller than ω_r, the frames of the film lie many turns and a part of a turn
apart: all turns between them would fill the ellipses, and are left out.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.grain_maps import (
    MAX_OUTLINED_GRAINS,
    draw_discs,
    frame_box,
)
from grainmodes.figures.shared.grain_rows import GRAINS
from grainmodes.figures.shared.map_scale import one_digit
from grainmodes.figures.shared.release_rows import (
    RUN,
    ReleasedState,
    one_released_state,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

DRAWN_LENGTH = 0.4
"""Length, in d, at which the longest displacements of most grains are drawn."""

CLOSE_UPS = 3
"""Number of grains that are shown in panels of their own."""

START_VARIABLES = ("position", "diameter", "box_length", "strain")
"""Variables of the state that was released."""

COLUMNS = {
    **{name: meaning for name, meaning in RUN.items() if name != "damping"},
    **{name: GRAINS[name] for name in ("box_length", "strain", "grain", "diameter")},
    "x": ("d", "x of the grain at the start"),
    "y": ("d", "y of the grain at the start"),
    "time": ("t_0", "time of a frame"),
    "dx": ("d", "displacement since the start"),
    "dy": ("d", "displacement since the start"),
    "factor": ("1", "by which displacements are drawn larger"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """A row per frame and grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    found = one_released_state(releases, options)
    shown = [state for state in found if np.isfinite(state.values("frame_time")).any()]
    return joined((_rows(state) for state in shown), COLUMNS)


def _rows(state: ReleasedState) -> pd.DataFrame:
    time = state.values("frame_time")
    film = state.values("film")[np.isfinite(time), :, :2]
    frames, n = film.shape[:2]
    start = {name: state.values(f"start_{name}") for name in START_VARIABLES}
    longest = np.quantile(np.hypot(*film.T).max(axis=1), 0.95)
    return pd.DataFrame(
        {
            **state.identity(),
            **{name: start[name] for name in ("box_length", "strain")},
            "grain": np.tile(np.arange(n), frames),
            "diameter": np.tile(start["diameter"], frames),
            "x": np.tile(start["position"][:, 0], frames),
            "y": np.tile(start["position"][:, 1], frames),
            "time": np.repeat(time[np.isfinite(time)], n),
            "dx": film[:, :, 0].ravel(),
            "dy": film[:, :, 1].ravel(),
            "factor": one_digit(DRAWN_LENGTH / longest),
        }
    )


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Trajectories of the grains of one state whose complex pair is released, while its "
        "motion grows: large, all grains in their box; beside it, the three that enclose the "
        "largest areas. Displacements are drawn larger than they are by the factor above the "
        "figure; time runs from light to dark.",
        "spirals that open: every grain circles with ω_r while its amplitude grows as exp(ω_i t).",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw every grain with its trajectory, and beside it the most open trajectories."""
    figure.set_size_inches(7.0, 4.9)
    figure.set_layout_engine("compressed")
    whole, close_ups = figure.subfigures(1, 2, width_ratios=(2.1, 1.0))
    paths = trajectories(table)
    axes = whole.subplots()
    draw_grains_at_start(axes, table)
    add_paths(axes, paths)
    for axes, grain in zip(close_ups.subplots(CLOSE_UPS, 1), _most_open(paths), strict=True):
        _draw_close_up(axes, paths[:, grain : grain + 1])
        axes.set_title(f"grain {grain}")
    factor = labels.power(table["factor"].iloc[0])
    note = rf"displacements drawn ${factor}$ times as long; time: light to dark"
    figure.suptitle(f"{release_caption(table)}\n{note}")


def _draw_close_up(axes: Axes, path: np.ndarray) -> None:
    add_paths(axes, path, lw=0.8)
    sides = np.array([-1.0, 1.0])
    middle, half = path.mean(axis=(0, 1)), 0.55 * np.ptp(path, axis=0).max()
    axes.set(xlim=middle[0] + half * sides, ylim=middle[1] + half * sides, aspect="equal")
    axes.set(xticks=[], yticks=[])


def _most_open(paths: np.ndarray) -> np.ndarray:
    """The grains whose trajectories enclose the largest area: (CLOSE_UPS,)."""
    moved = paths - paths[:1]
    step = np.diff(moved, axis=0)
    area = moved[:-1, :, 0] * step[:, :, 1] - moved[:-1, :, 1] * step[:, :, 0]
    return np.argsort(-np.abs(area.sum(axis=0)))[:CLOSE_UPS]


def add_paths(axes: Axes, paths: np.ndarray, lw: float = 0.5) -> LineCollection:
    """Draw trajectories (frame, grain, 2) as lines from light to dark; returns these lines."""
    segments = np.stack([paths[:-1], paths[1:]], axis=2)
    shades = np.repeat(np.linspace(0.0, 1.0, len(segments)), paths.shape[1])
    lines = LineCollection(segments.reshape(-1, 2, 2), array=shades, cmap="viridis_r", lw=lw)
    lines.set_clim(0.0, 1.0)
    lines.set_rasterized(paths.shape[1] > MAX_OUTLINED_GRAINS // 4)
    axes.add_collection(lines)
    return lines


def draw_grains_at_start(axes: Axes, table: pd.DataFrame) -> None:
    """Draw the grains at the start, as empty circles in their box."""
    start = table.drop_duplicates("grain")
    draw_discs(axes, start, np.full(len(start), np.nan))
    frame_box(axes, start)


def trajectories(table: pd.DataFrame) -> np.ndarray:
    """Positions to draw, (frame, grain, 2), in d."""
    moved = table[["dx", "dy"]].to_numpy() * table[["factor"]].to_numpy()
    return (table[["x", "y"]].to_numpy() + moved).reshape(-1, table["grain"].nunique(), 2)
