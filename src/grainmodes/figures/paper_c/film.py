"""The spirals of a released pair as a film: the trajectories of C, Fig. 5, as they grow in time.

A part of the box is shown. Dots are the grains, lines their trajectories during the last frames;
displacements are drawn larger than they are, by the factor above the film.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from grainmodes.figures.paper_c import release_spirals
from grainmodes.figures.shared import labels, missing
from grainmodes.figures.shared.appearance import ROTATIONAL, TRANSLATIONAL, house_style
from grainmodes.figures.shared.release_rows import release_caption
from grainmodes.figures.shared.sample_files import read_samples
from grainmodes.figures.shared.selection import Options
from grainmodes.runtime.atomic import replaced

FRAMES_PER_SECOND, DOTS_PER_INCH = 20, 110

MAX_SIDE = 12.0
"""Largest side of the part of the box that is shown, in d."""

TRAIL_FRAMES = 24
"""Number of frames for which a trajectory stays visible, about a turn."""


def write(data: list[Path], output: Path, options: dict) -> None:
    """Write the film of one released sample as a GIF; a single empty frame if there is none.

    Args:
        data: files of `grainmodes release`.
        options: keys of `selection.Options`; {} for the sample that the figure shows.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
        BlockError: a file is not readable.
        OSError: the file cannot be written.
    """
    releases = read_samples(data, "release")
    name, chosen = "release_spirals", Options.read("release_spirals", options)
    table = release_spirals.table(releases, chosen)
    if not table.empty:
        chosen.check_used(name)
    lacking = missing.notes(name, missing.shortages(name, releases), table)
    with house_style():
        figure = Figure(figsize=(4.4, 4.8))
        FigureCanvasAgg(figure)
        with replaced(output) as partial:
            # Pillow chooses the format by the suffix alone
            with_suffix = partial.with_suffix(".gif")
            if table.empty:
                labels.say_empty(figure, lacking)
                figure.savefig(with_suffix, format="gif", dpi=DOTS_PER_INCH)
            else:
                _write_frames(figure, table, lacking, with_suffix)
            with_suffix.replace(partial)


def _write_frames(figure: Figure, table, lacking: list[str], path: Path) -> None:
    axes, paths = figure.subplots(), release_spirals.trajectories(table)
    release_spirals.draw_grains_at_start(axes, table)
    side = min(MAX_SIDE, table["box_length"].iloc[0])
    axes.set(xlim=(0.0, side), ylim=(0.0, side))
    factor = labels.power(table["factor"].iloc[0])
    note = f"displacements drawn ${factor}$ times as long"
    figure.suptitle("\n".join([release_caption(table), note, *lacking]))
    lines = release_spirals.add_paths(axes, paths[:2])
    lines.set(array=None, color=ROTATIONAL, lw=0.9)
    (heads,) = axes.plot([], [], ".", color=TRANSLATIONAL, ms=3.0)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # laid out once, not for every frame
    writer = PillowWriter(fps=FRAMES_PER_SECOND)
    with writer.saving(figure, path, DOTS_PER_INCH):
        for frame in range(1, len(paths)):
            trail = paths[max(0, frame - TRAIL_FRAMES) : frame + 1]
            lines.set_segments(list(np.moveaxis(trail, 1, 0)))
            heads.set_data(*trail[-1].T)
            writer.grab_frame()
