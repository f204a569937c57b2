"""Draw a work-precision diagram: `python -m measurements.accuracy.draw strain_step.csv -o stem`.

(a) error against CPU seconds, (b) error against the setting, (c) peak memory; of many curves those
of each quantity have two panels of their own, time above setting. A setting at which some samples
failed has an open symbol, and a cross at the upper edge if all failed; an error of zero is a
triangle at the lower edge.
"""

from __future__ import annotations

import argparse
import math
import sys
import textwrap
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from grainmodes.figures import DOTS_PER_INCH
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import house_style
from grainmodes.runtime.atomic import replaced
from measurements.accuracy import panels
from measurements.accuracy.table import Table, curves, read

CAPTION_WIDTH = 130
"""Number of letters in a line of the caption."""

MAX_NAMED_SETTINGS = 3
"""Number of settings up to which each has a label at the axis."""

MAX_COLUMNS = 4
"""Number of quantities side by side."""


def draw(figure: Figure, table: Table) -> None:
    """Draw the panels, the legend below them and the caption above."""
    rows = curves(table)
    styles, shared = panels.assign_styles(list(rows)), panels.share_panels(list(rows))
    entries = _entries(styles, together=len(shared) == 1)
    lay_out = _in_one_line if len(shared) == 1 else _in_lines
    pairs, memory = lay_out(figure, len(shared), 0.16 * math.ceil(len(entries) / 3))
    edges = _edges(table)
    for index, ((title, names), (time, setting)) in enumerate(
        zip(shared.items(), pairs, strict=True)
    ):
        for name in names:
            panels.draw_curve(time, rows[name], styles[name], edges, lambda row: row.seconds)
            panels.draw_curve(setting, rows[name], styles[name], edges, lambda row: row.setting)
        labels.name_panel(time, index, title or "work and precision")
        if not title:
            labels.name_panel(setting, 1, "setting")
    for name, style in styles.items():
        panels.draw_memory(memory, rows[name], style)
    labels.name_panel(memory, len(shared) + (len(shared) == 1), "memory")
    _finish(pairs, memory, table, edges)
    figure.legend(handles=entries, loc="outside lower center", ncols=3)
    figure.suptitle("\n".join(_caption(table)))


def _in_one_line(figure: Figure, count: int, legend: float) -> tuple[list[tuple], Axes]:
    """One pair of panels and the memory side by side; `legend` is its height in inches."""
    figure.set_size_inches(7.0, 3.3 + legend)
    time, setting, memory = figure.subplots(1, 3, width_ratios=(3.0, 3.0, 1.8))
    return [(time, setting)], memory


def _in_lines(figure: Figure, count: int, legend: float) -> tuple[list[tuple], Axes]:
    """Pairs of panels, time above setting, some side by side, then the memory."""
    cells = count + 1
    lines = math.ceil(cells / MAX_COLUMNS)
    columns = math.ceil(cells / lines)
    figure.set_size_inches(7.0, 0.8 + 3.3 * lines + legend)
    grid = figure.subplots(2 * lines, columns, squeeze=False)
    places = [(2 * line, column) for line in range(lines) for column in range(columns)]
    pairs = [(grid[row, column], grid[row + 1, column]) for row, column in places]
    memory, *empty = (axes for pair in pairs[count:] for axes in pair)
    for axes in empty:
        axes.set_visible(False)
    return pairs[:count], memory


def _finish(pairs: list[tuple], memory: Axes, table: Table, edges: tuple[float, float]) -> None:
    """Scale and label all axes; of panels side by side the leftmost carries what all share."""
    words, tried = table.words, table.rows["setting"].unique()
    alone = len(pairs) == 1
    size = 10 if alone else 8
    for time, setting in pairs:
        panels.scale_time(time, (1, 2, 5) if alone else (1, 3))
        panels.scale_time(setting, (1,))
        if len(tried) <= MAX_NAMED_SETTINGS:
            setting.set_xticks(tried, [f"{value:g}" for value in tried], minor=False)
        time.set_xlabel(f"CPU s per {words['unit']}", fontsize=size)
        if alone or _is_leftmost(setting):
            setting.set_xlabel(words["setting"], fontsize=size, loc="center" if alone else "left")
        for axes in (time, setting):
            axes.set(yscale="log", ylim=(edges[0] / 4, edges[1] * 2))
            if _is_leftmost(axes):
                axes.set_ylabel(words["error"], fontsize=size)
            else:
                axes.tick_params(labelleft=False)
    panels.scale_time(memory, (1, 3))
    panels.scale_memory(memory, table)
    memory.set_xlabel(f"CPU s per {words['unit']}", fontsize=size)
    memory.set_ylabel("peak memory / MB", fontsize=size)


def _is_leftmost(axes: Axes) -> bool:
    place = axes.get_subplotspec()
    return place is not None and place.colspan.start == 0


def _entries(styles: dict[str, panels.CurveStyle], together: bool) -> list[Line2D]:
    """The legend: knee and default, then all curves, or the methods of many."""
    rings = [
        Line2D([], [], marker=marker, label=kind, ms=size, **panels.RING)
        for kind, (marker, size) in panels.RINGS.items()
    ]
    names = {
        name if together else panels.method_and_quantity(name)[0]: style
        for name, style in styles.items()
    }
    return rings + [Line2D([], [], label=name, **style._asdict()) for name, style in names.items()]


def _edges(table: Table) -> tuple[float, float]:
    """The errors at which zeros and failures are drawn: a little beyond all others."""
    errors = table.rows["error"]
    shown = errors[(errors > 0.0) & (errors < math.inf)]
    return (shown.min() / 4.0, shown.max() * 4.0) if len(shown) else (0.1, 1.0)


def _caption(table: Table) -> list[str]:
    words, counts = table.words, table.rows["samples"] + table.rows["failed"]
    grains = f"N = {words['grains']}, {labels.count_samples(counts)}"
    text = f"{words['title']}; {grains}. Reference: {words['reference']}."
    return [*textwrap.wrap(text, CAPTION_WIDTH), f"{words['machine']}; grainmodes {words['code']}"]


def write(stem: Path, table: Table) -> None:
    """Write `stem`.png and `stem`.pdf, both or none.

    Raises:
        OSError: one of them cannot be written.
    """
    with house_style():
        figure = Figure()
        FigureCanvasAgg(figure)
        draw(figure, table)
        png, pdf = (stem.with_name(stem.name + suffix) for suffix in (".png", ".pdf"))
        with replaced(png) as png, replaced(pdf) as pdf:
            figure.savefig(png, format="png", dpi=DOTS_PER_INCH, metadata={"Software": None})
            figure.savefig(pdf, format="pdf", metadata={"CreationDate": None})


def main() -> int:
    """Read the command line; returns 0, or 1 for a file that is not a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", type=Path, metavar="CSV")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="STEM")
    arguments = parser.parse_args()
    try:
        write(arguments.output, read(arguments.table))
    except (OSError, ValueError) as error:
        print(f"draw.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
