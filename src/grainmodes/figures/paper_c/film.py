"""The spirals of a released pair as a film: the trajectories of Fig. 5 of C growing in time."""

from __future__ import annotations

from pathlib import Path

import matplotlib.style
import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from grainmodes.dataset.files import BlockError
from grainmodes.figures import STYLE
from grainmodes.figures.paper_c import release_spirals
from grainmodes.figures.shared import appearance, field_rows
from grainmodes.figures.shared.release_rows import caption
from grainmodes.figures.shared.selection import Options
from grainmodes.runtime.atomic import replaced

RATE, RESOLUTION = 20, 110
"""Frames a second; dots per inch."""

WINDOW = 12.0
"""Side of the part of the box that is shown, in d."""

TAIL = 24
"""Frames for which a place is seen, a turn."""


def write(data: list[Path], output: Path, options: dict) -> None:
    """Write the film of one released sample as a GIF.

    Args:
        data: files of `grainmodes release`.
        options: keys of `selection.Options`; {} for the sample that the figure shows.

    Raises:
        ValueError: no sample has the n, phi, kt or seed asked for.
        BlockError: a file is not readable, or none holds a film.
        OSError: the file cannot be written.
    """
    name = "release_spirals"
    releases = field_rows.read(data, "release")
    table = release_spirals.table(releases, Options.read(name, options))
    if table.empty:
        raise BlockError("no sample was released far enough to hold a film")
    with matplotlib.style.context(STYLE):
        figure = Figure(figsize=(4.4, 4.8))
        FigureCanvasAgg(figure)
        with replaced(output) as partial:
            # Pillow tells the format by the suffix alone
            whole = partial.with_suffix(".gif")
            _write(figure, table, whole)
            whole.replace(partial)


def _write(figure: Figure, table, path: Path) -> None:
    axes, paths = figure.subplots(), release_spirals.trajectories(table)
    release_spirals.ground(axes, table)
    side = min(WINDOW, table["box_length"].iloc[0])
    axes.set(xlim=(0.0, side), ylim=(0.0, side))
    factor = appearance.power(table["factor"].iloc[0])
    figure.suptitle(f"{caption(table)}\ndisplacements drawn ${factor}$ times as long")
    colours = appearance.ROTATIONAL, appearance.TRANSLATIONAL
    lines = release_spirals.add_paths(axes, paths[:2])
    lines.set(array=None, color=colours[0], lw=0.9)
    (heads,) = axes.plot([], [], ".", color=colours[1], ms=3.0)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # laid out once, not for every frame
    writer = PillowWriter(fps=RATE)
    with writer.saving(figure, path, RESOLUTION):
        for frame in range(1, len(paths)):
            seen = paths[max(0, frame - TAIL) : frame + 1]
            lines.set_segments(list(np.moveaxis(seen, 1, 0)))
            heads.set_data(*seen[-1].T)
            writer.grab_frame()
