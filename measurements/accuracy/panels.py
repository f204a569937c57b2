"""Panels of a work-precision diagram, and how its curves are drawn and share panels.

A curve with a name "method, quantity" takes its symbol and line from the method. A few curves share
their panels and take their colour from the quantity; of many, those of each quantity have panels of
their own and take their colour from the method, so that the legend names methods alone.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from grainmodes.figures.shared import appearance
from measurements.accuracy.diagram import DiagramRow, knee
from measurements.accuracy.table import Table

LINES = ("-", "--", ":", "-.")

MAX_TOGETHER = 6
"""Number of curves up to which all share one panel."""

RINGS = {"knee": ("o", 9.0), "default": ("s", 10.5)}
"""Symbols around the points of the knee and of the default, and their sizes."""

RING = {"mfc": "none", "mec": "k", "mew": 0.8, "ls": ""}

SHORT_AXIS_RATIO = 100.0
"""Ratio of the limits of an axis below which labels at powers of ten alone would be too few."""

LOGARITHMIC_MEMORY_RATIO = 10.0
"""Ratio of the largest memory to the smallest above which its axis is logarithmic."""


class CurveStyle(NamedTuple):
    """How a curve is drawn."""

    color: tuple
    marker: str
    linestyle: str


def share_panels(names: list[str]) -> dict[str, list[str]]:
    """Title of a panel → the curves that it shows: all in one without a title, or by quantity."""
    if len(names) <= MAX_TOGETHER:
        return {"": names}
    quantities = dict.fromkeys(method_and_quantity(name)[1] for name in names)
    return {
        quantity: [name for name in names if method_and_quantity(name)[1] == quantity]
        for quantity in quantities
    }


def assign_styles(names: list[str]) -> dict[str, CurveStyle]:
    """How each curve "method, quantity" is drawn; a name without a comma is a quantity."""
    split = {name: method_and_quantity(name) for name in names}
    methods, quantities = (list(dict.fromkeys(part)) for part in zip(*split.values(), strict=True))
    together = len(share_panels(names)) == 1
    coloured = quantities if together else methods
    colours = {value: colour for value, colour, _ in appearance.curve_styles(coloured)}
    return {
        name: CurveStyle(
            colours[quantity if together else method],
            appearance.MARKERS[methods.index(method) % len(appearance.MARKERS)],
            LINES[methods.index(method) % len(LINES)],
        )
        for name, (method, quantity) in split.items()
    }


def method_and_quantity(name: str) -> tuple[str, str]:
    """The two parts of the name of a curve; without a comma it is a quantity."""
    method, comma, quantity = name.partition(", ")
    return (method, quantity) if comma else ("", name)


def draw_curve(
    axes: Axes, rows: list[DiagramRow], style: CurveStyle, edges: tuple, across: Callable
) -> None:
    """Draw a curve with its bars, the points beyond the edges, and the symbols around points."""
    counted = [row for row in rows if edges[0] < row.error < edges[1]]
    x, y = [across(row) for row in counted], [row.error for row in counted]
    symbol = {"color": style.color, "marker": style.marker}
    axes.errorbar(x, y, _bars(counted), linestyle=style.linestyle, elinewidth=0.5, **symbol)
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
    """Lengths of the bars (2, R); without a spread there is none."""
    error, spread = (np.array([getattr(row, name) for row in rows]) for name in ("error", "spread"))
    return appearance.logarithmic_bars(error, np.nan_to_num(spread))


def _ring(axes: Axes, row: DiagramRow | None, kind: str, edges: tuple, across: Callable) -> None:
    marker, size = RINGS[kind]
    if row is not None:
        axes.plot(across(row), max(row.error, edges[0]), marker, ms=size, **RING)


def draw_memory(axes: Axes, rows: list[DiagramRow], style: CurveStyle) -> None:
    """Draw peak memory against CPU seconds."""
    seconds, megabytes = [row.seconds for row in rows], [row.megabytes for row in rows]
    axes.plot(seconds, megabytes, ms=3.0, **style._asdict())


def scale_time(axes: Axes, subs: tuple[int, ...]) -> None:
    """A logarithmic axis; one that is short has labels at these parts of a decade."""
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    if high < SHORT_AXIS_RATIO * low:
        axes.xaxis.set_major_locator(LogLocator(subs=subs))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def scale_memory(axes: Axes, table: Table) -> None:
    """A linear axis from 0, or a logarithmic one where memory spans a decade."""
    megabytes = table.rows["megabytes"]
    if megabytes.max() > LOGARITHMIC_MEMORY_RATIO * megabytes.min():
        axes.set_yscale("log")
    else:
        axes.set_ylim(0.0, 1.15 * megabytes.max())
