"""Draw a work-precision diagram: `python -m measurements.accuracy.draw strain_step.csv -o stem`.

(a) error against CPU seconds, (b) error against the setting, (c) peak memory. A curve with a name
"method, quantity" takes its symbol and line from the method, its colour from the quantity. A
setting at which some samples failed has an open symbol, and a cross at the upper edge if all
failed; an error of zero is a triangle at the lower edge.
"""

from __future__ import annotations

import argparse
import math
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import matplotlib.style
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from grainmodes.figures import DOTS_PER_INCH, STYLE
from grainmodes.figures.shared import appearance, labels
from grainmodes.runtime.atomic import replaced
from measurements.accuracy.diagram import DiagramRow, knee
from measurements.accuracy.table import Table, curves, read

LINES = ("-", "--", ":", "-.")
CAPTION_WIDTH = 130
"""Number of letters in a line of the caption."""

RINGS = {"knee": ("o", 9.0), "default": ("s", 10.5)}
"""Symbols around the points of the knee and of the default, and their sizes."""

RING = {"mfc": "none", "mec": "k", "mew": 0.8, "ls": ""}

SHORT_AXIS_RATIO = 100.0
"""Ratio of the limits of an axis below which labels at powers of ten alone would be too few."""

MAX_NAMED_SETTINGS = 3
"""Number of settings up to which each has a label at the axis."""

LOGARITHMIC_MEMORY_RATIO = 10.0
"""Ratio of the largest memory to the smallest above which its axis is logarithmic."""


class CurveStyle(NamedTuple):
    """How a curve is drawn."""

    color: tuple
    marker: str
    linestyle: str


def assign_styles(names: list[str]) -> dict[str, CurveStyle]:
    """How each curve "method, quantity" is drawn; a name without a comma is a quantity."""
    split = {name: _method_and_quantity(name) for name in names}
    methods, quantities = (list(dict.fromkeys(part)) for part in zip(*split.values(), strict=True))
    colours = {quantity: colour for quantity, colour, _ in appearance.curve_styles(quantities)}
    return {
        name: CurveStyle(
            colours[quantity],
            appearance.MARKERS[methods.index(method) % len(appearance.MARKERS)],
            LINES[methods.index(method) % len(LINES)],
        )
        for name, (method, quantity) in split.items()
    }


def _method_and_quantity(name: str) -> tuple[str, str]:
    method, comma, quantity = name.partition(", ")
    return (method, quantity) if comma else ("", name)


def draw(figure: Figure, table: Table) -> None:
    """Draw the three panels, the legend below them and the caption above."""
    rows, words = curves(table), table.words
    figure.set_size_inches(7.0, 3.3 + 0.16 * math.ceil((len(rows) + len(RINGS)) / 3))
    against_time, against_setting, memory = figure.subplots(1, 3, width_ratios=(3.0, 3.0, 1.8))
    against_setting.sharey(against_time)
    edges = _edges(table)
    for name, style in assign_styles(list(rows)).items():
        _curve(against_time, rows[name], style, edges, lambda row: row.seconds, name)
        _curve(against_setting, rows[name], style, edges, lambda row: row.setting)
        _memory(memory, rows[name], style)
    for axes, subs in ((against_time, (1, 2, 5)), (against_setting, (1,)), (memory, (1, 3))):
        _scale(axes, subs)
    tried = table.rows["setting"].unique()
    if len(tried) <= MAX_NAMED_SETTINGS:
        against_setting.set_xticks(tried, [f"{setting:g}" for setting in tried], minor=False)
    for axes in (against_time, against_setting):
        axes.set(yscale="log", ylim=(edges[0] / 4, edges[1] * 2))
    against_setting.tick_params(labelleft=False)
    against_time.set(xlabel=f"CPU s per {words['unit']}", ylabel=words["error"])
    against_setting.set(xlabel=words["setting"])
    memory.set(xlabel=against_time.get_xlabel(), ylabel="peak memory / MB")
    _scale_memory(memory, table)
    for kind, (marker, size) in RINGS.items():
        against_time.plot([], [], marker, label=kind, ms=size, **RING)
    for index, axes in enumerate((against_time, against_setting, memory)):
        labels.name_panel(axes, index, ("work and precision", "setting", "memory")[index])
    figure.legend(loc="outside lower center", ncols=3)
    figure.suptitle("\n".join(_caption(table)))


def _edges(table: Table) -> tuple[float, float]:
    """The errors at which zeros and failures are drawn: a little beyond all others."""
    errors = table.rows["error"]
    shown = errors[(errors > 0.0) & (errors < math.inf)]
    return (shown.min() / 4.0, shown.max() * 4.0) if len(shown) else (0.1, 1.0)


def _curve(
    axes: Axes, rows: list[DiagramRow], style: CurveStyle, edges, across: Callable, label: str = "_"
) -> None:
    """Draw a curve with its bars, the points beyond the edges, and the symbols around points."""
    counted = [row for row in rows if edges[0] < row.error < edges[1]]
    x, y = [across(row) for row in counted], [row.error for row in counted]
    symbol = {"color": style.color, "marker": style.marker}
    line = {"linestyle": style.linestyle, "elinewidth": 0.5, "label": label}
    axes.errorbar(x, y, _bars(counted), **line, **symbol)
    partly = [row for row in counted if row.failed]
    axes.plot([across(r) for r in partly], [r.error for r in partly], ls="", mfc="white", **symbol)
    for row in rows:
        if row not in counted:
            edge, marker = (edges[0], "v") if row.error == 0.0 else (edges[1], "x")
            axes.plot(across(row), edge, marker, color=style.color, clip_on=False)
    _ring(axes, knee(rows), "knee", edges, across)
    for row in rows:
        if row.default:
            _ring(axes, row, "default", edges, across)


def _bars(rows: list[DiagramRow]) -> np.ndarray:
    """Lengths of the bars (2, R): the same factor down as up, so that none reaches zero."""
    error, spread = (np.array([getattr(row, name) for row in rows]) for name in ("error", "spread"))
    spread = np.nan_to_num(spread)
    return np.stack([spread / (1.0 + spread / error), spread])


def _ring(axes: Axes, row: DiagramRow | None, kind: str, edges, across: Callable) -> None:
    marker, size = RINGS[kind]
    if row is not None:
        axes.plot(across(row), max(row.error, edges[0]), marker, ms=size, **RING)


def _memory(axes: Axes, rows: list[DiagramRow], style: CurveStyle) -> None:
    seconds, megabytes = [row.seconds for row in rows], [row.megabytes for row in rows]
    axes.plot(seconds, megabytes, ms=3.0, **style._asdict())


def _scale(axes: Axes, subs: tuple[int, ...]) -> None:
    """A logarithmic axis; one that is short has labels at these parts of a decade."""
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    if high < SHORT_AXIS_RATIO * low:
        axes.xaxis.set_major_locator(LogLocator(subs=subs))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def _scale_memory(axes: Axes, table: Table) -> None:
    megabytes = table.rows["megabytes"]
    if megabytes.max() > LOGARITHMIC_MEMORY_RATIO * megabytes.min():
        axes.set_yscale("log")
    else:
        axes.set_ylim(0.0, 1.15 * megabytes.max())


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
    with matplotlib.style.context(STYLE):
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
