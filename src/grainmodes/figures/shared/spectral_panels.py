"""Panels of spectra: a grid with a panel per k_T, or one panel with a curve per N or φ.

Symbols are means over the samples, bars their standard errors, on a logarithmic axis as long below
as above; a bin without modes has no symbol.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import (
    add_to_legend,
    curve_styles,
    draw_cloud,
    logarithmic_bars,
    logarithmic_limits,
    scale_logarithmically,
)

PANEL_COLUMNS = 2
DENSITY_LABEL = r"$D(\omega) / t_0$"


def draw_panels(
    figure: Figure,
    table: pd.DataFrame,
    ordinate: str,
    draw: Callable[[Axes, pd.DataFrame], None],
    note: str = "",
) -> dict[Axes, float]:
    """Draw the rows of each k_T over a logarithmic axis of ω, two panels side by side.

    The two share their axes; the next two, of larger k_T, span fewer decades and have their own.

    Args:
        ordinate: label of the vertical axis.
        draw: function that draws the rows of one k_T into a panel.
        note: what the caption says below the numbers.

    Returns:
        panel → k_T, ascending.
    """
    kts = sorted(table["kt"].unique())
    panels = dict(zip(_grid(figure, len(kts)), kts, strict=True))
    for index, (axes, kt) in enumerate(panels.items()):
        draw(axes, table[table["kt"] == kt])
        labels.name_panel(axes, index, f"$k_T / k_N = {labels.ratio(kt)}$")
    for axes in panels:
        scale_logarithmically(axes)
    figure.supxlabel(r"$\omega t_0$", fontsize=10)
    figure.supylabel(ordinate, fontsize=10)
    labels.write_caption(figure, table, ("n", "phi"), note)
    return panels


def _grid(figure: Figure, count: int) -> list[Axes]:
    columns = min(PANEL_COLUMNS, count)
    lines = -(-count // columns)
    figure.set_size_inches(3.5 * columns, 0.4 + 2.4 * lines)
    grid = figure.subplots(lines, columns, squeeze=False, sharex="row", sharey="row")
    for axes in grid[:, 1:].ravel():
        axes.tick_params(labelleft=False)
    for axes in grid.ravel()[count:]:
        axes.set_visible(False)
    return list(grid.ravel()[:count])


def draw_density_panels(
    figure: Figure, table: pd.DataFrame, draw: Callable[[Axes, pd.DataFrame], None]
) -> dict[Axes, float]:
    """Draw panels of D, double logarithmic; returns panel → k_T."""
    filled = table[table["modes"] > 0]
    panels = draw_panels(figure, filled, DENSITY_LABEL, draw)
    ordered = list(panels)
    densities = [density for _, density in filled.groupby("kt")["density"]]
    for first in range(0, len(ordered), PANEL_COLUMNS):
        row = pd.concat(densities[first : first + PANEL_COLUMNS])
        ordered[first].set(yscale="log", ylim=logarithmic_limits(row))
    return panels


def draw_density_kinds(figure: Figure, table: pd.DataFrame, styles: dict[str, dict]) -> None:
    """Draw panels of D with spectra of several kinds in each."""
    draw_kinds_in_styles = partial(draw_kinds, column="density", styles=styles)
    first, *_ = draw_density_panels(figure, table, draw_kinds_in_styles)
    first.legend()


def draw_kinds(axes: Axes, rows: pd.DataFrame, column: str, styles: dict[str, dict]) -> None:
    """Draw spectra of several kinds, each in its style; the first kind lies on top."""
    for place, (kind, style) in enumerate(styles.items()):
        draw_spectrum(axes, rows[rows["kind"] == kind], column, zorder=3 - place / 10, **style)


def draw_spectrum(
    axes: Axes, rows: pd.DataFrame, column: str, label: str, colour, marker: str, **style
) -> None:
    """Draw a column of rows over a logarithmic axis against ω, and its entry in the legend;
    nothing without values."""
    if rows[column].notna().any():
        bars = logarithmic_bars(rows[column], rows[f"{column}_standard_error"])
        draw_cloud(axes, rows["omega"], rows[column], bars, colour, marker, **style)
        entry = {key: style[key] for key in ("mfc",) if key in style}
        add_to_legend(axes, label, colour, marker, **entry)


def one_density_panel(figure: Figure, filled: pd.DataFrame) -> Axes:
    """Axes for D of rows with modes, double logarithmic."""
    axes = figure.subplots()
    axes.set(xscale="log", yscale="log", xlabel=r"$\omega t_0$", ylabel=DENSITY_LABEL)
    axes.set(ylim=logarithmic_limits(filled["density"]))
    return axes


def draw_density_curves(figure: Figure, table: pd.DataFrame, column: str, label: Callable) -> Axes:
    """Draw D for every value of a column in one panel; a line ends where a bin has no modes."""
    axes = one_density_panel(figure, table[table["modes"] > 0])
    table = table.assign(density=table["density"].where(table["modes"] > 0))
    for value, colour, marker in curve_styles(sorted(table[column].unique())):
        rows = table[table[column] == value]
        axes.plot(rows["omega"], rows["density"], color=colour, linewidth=0.5)
        draw_spectrum(axes, rows, "density", label(value), colour, marker, markersize=1.5)
    return axes
