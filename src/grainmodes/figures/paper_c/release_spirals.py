"""Trajectories of the grains while a released pair grows: spirals (C, Fig. 5).

The frames of the film lie many turns and a part of one apart where ω_i is much smaller than ω_r:
turns so many that they would fill the ellipses between them are left out.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import GRAINS, joined
from grainmodes.figures.shared.grain_maps import OUTLINED, draw_discs, rounded
from grainmodes.figures.shared.release_rows import COLUMNS as RUN
from grainmodes.figures.shared.release_rows import Sample, caption, one
from grainmodes.figures.shared.selection import Options

REACH = 0.4
"""Length, in d, of the longest displacements of most grains as they are drawn."""

COLUMNS = {
    **{name: RUN[name] for name in ("n", "phi", "kt", "seed", "rate", "frequency")},
    **{name: GRAINS[name] for name in ("box_length", "strain", "grain", "diameter")},
    "x": ("d", "place of the grain at the start"),
    "y": ("d", "place of the grain at the start"),
    "time": ("t_0", "time of a frame"),
    "dx": ("d", "displacement since the start"),
    "dy": ("d", "displacement since the start"),
    "factor": ("1", "by which displacements are drawn larger"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """A row per frame and grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi, kt or seed asked for.
    """
    shown = [sample for sample in one(releases, options) if len(sample.of("film"))]
    return joined((_rows(sample) for sample in shown), COLUMNS)


def _rows(sample: Sample) -> pd.DataFrame:
    film = sample.of("film")[:, :, :2]
    frames, n = film.shape[:2]
    place = {name: sample.block.variables[name][sample.row] for name in STILL}
    longest = np.quantile(np.hypot(*film.T).max(axis=1), 0.95)
    return pd.DataFrame(
        {
            **sample.columns(),
            **{name: place[name] for name in ("box_length", "strain")},
            "grain": np.tile(np.arange(n), frames),
            "diameter": np.tile(place["diameter"], frames),
            "x": np.tile(place["position"][:, 0], frames),
            "y": np.tile(place["position"][:, 1], frames),
            "time": np.repeat(sample.of("frame_time"), n),
            "dx": film[:, :, 0].ravel(),
            "dy": film[:, :, 1].ravel(),
            "factor": rounded(REACH / longest),
        }
    )


STILL = ("position", "diameter", "box_length", "strain")
"""Variables of the state that was released."""


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Every grain with its trajectory, from light to dark; beside it those most open."""
    figure.set_size_inches(7.0, 4.9)
    figure.set_layout_engine("compressed")
    whole, near = figure.subfigures(1, 2, width_ratios=(2.1, 1.0))
    paths = trajectories(table)
    axes = whole.subplots()
    ground(axes, table)
    add_paths(axes, paths)
    for axes, grain in zip(near.subplots(CLOSE, 1), _most_open(paths), strict=True):
        path = paths[:, grain : grain + 1]
        add_paths(axes, path, lw=0.8)
        middle, half = path.mean(axis=(0, 1)), 0.55 * np.ptp(path, axis=0).max()
        axes.set(xlim=middle[0] + half * SIDES, ylim=middle[1] + half * SIDES, aspect="equal")
        axes.set(xticks=[], yticks=[], title=f"grain {grain}")
    factor = appearance.power(table["factor"].iloc[0])
    note = rf"displacements drawn ${factor}$ times as long; time: light to dark"
    figure.suptitle(f"{caption(table)}\n{note}")


CLOSE = 3
"""Grains that are shown closely."""

SIDES = np.array([-1.0, 1.0])


def _most_open(paths: np.ndarray) -> np.ndarray:
    """The grains whose trajectories sweep most area: (CLOSE,)."""
    moved = paths - paths[:1]
    step = np.diff(moved, axis=0)
    area = moved[:-1, :, 0] * step[:, :, 1] - moved[:-1, :, 1] * step[:, :, 0]
    return np.argsort(-np.abs(area.sum(axis=0)))[:CLOSE]


def add_paths(axes: Axes, paths: np.ndarray, lw: float = 0.5) -> LineCollection:
    """Trajectories (frame, grain, 2) as lines from light to dark; returned to be changed."""
    segments = np.stack([paths[:-1], paths[1:]], axis=2)
    shades = np.repeat(np.linspace(0.0, 1.0, len(segments)), paths.shape[1])
    lines = LineCollection(segments.reshape(-1, 2, 2), array=shades, cmap="viridis_r", lw=lw)
    lines.set_clim(0.0, 1.0)
    lines.set_rasterized(paths.shape[1] > OUTLINED // 4)
    axes.add_collection(lines)
    return lines


def ground(axes: Axes, table: pd.DataFrame) -> None:
    """The grains at the start, as empty circles in their box."""
    still = table.drop_duplicates("grain")
    length = still["box_length"].iloc[0]
    draw_discs(axes, still, np.full(len(still), np.nan), 1.0)
    axes.set(xlim=(0.0, length), ylim=(0.0, length), aspect="equal", xlabel="$x/d$", ylabel="$y/d$")
    axes.tick_params(direction="out", top=False, right=False, which="both")


def trajectories(table: pd.DataFrame) -> np.ndarray:
    """Places to draw, (frame, grain, 2)."""
    moved = table[["dx", "dy"]].to_numpy() * table[["factor"]].to_numpy()
    return (table[["x", "y"]].to_numpy() + moved).reshape(-1, table["grain"].nunique(), 2)
