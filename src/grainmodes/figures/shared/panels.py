"""Panels of spectra: a grid of one per k_T, or one with a curve per N or phi."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance

COLUMNS = 2
DENSITY = r"$D(\omega) / t_0$"


def draw_panels(
    figure: Figure,
    table: pd.DataFrame,
    ordinate: str,
    draw: Callable[[Axes, pd.DataFrame], None],
    note: str = "",
) -> list[Axes]:
    """Draw the rows of each k_T over a logarithmic axis of omega, two panels side by side.

    The two share their axes; the next two, of stiffer k_T, span fewer decades and have their own.

    Args:
        ordinate: label of the vertical axis.
        draw: draws the rows of one k_T into a panel.
        note: what the caption says below the numbers.

    Returns:
        the panels, ascending in k_T.
    """
    kappas = sorted(table["kt"].unique())
    panels = _grid(figure, len(kappas))
    for index, (axes, kappa) in enumerate(zip(panels, kappas, strict=True)):
        draw(axes, table[table["kt"] == kappa])
        appearance.name_panel(axes, index, f"$k_T / k_N = {appearance.power(kappa)}$")
    for axes in panels:
        appearance.scale_frequencies(axes)
    figure.supxlabel(r"$\omega t_0$", fontsize=10)
    figure.supylabel(ordinate, fontsize=10)
    appearance.write_caption(figure, table, ("n", "phi"), note)
    return panels


def _grid(figure: Figure, count: int) -> list[Axes]:
    columns = min(COLUMNS, count)
    lines = -(-count // columns)
    figure.set_size_inches(3.5 * columns, 0.4 + 2.4 * lines)
    grid = figure.subplots(lines, columns, squeeze=False, sharex="row", sharey="row")
    for axes in grid[:, 1:].ravel():
        axes.tick_params(labelleft=False)
    for axes in grid.ravel()[count:]:
        axes.set_visible(False)
    return list(grid.ravel()[:count])


def draw_densities(
    figure: Figure, table: pd.DataFrame, draw: Callable[[Axes, pd.DataFrame], None]
) -> list[Axes]:
    """Panels of D, double logarithmic; a bin without modes has no symbol."""
    filled = table[table["modes"] > 0]
    panels = draw_panels(figure, filled, DENSITY, draw)
    of = [density for _, density in filled.groupby("kt")["density"]]
    for first in range(0, len(panels), COLUMNS):
        row = pd.concat(of[first : first + COLUMNS])
        panels[first].set(yscale="log", ylim=appearance.logarithmic_limits(row))
    return panels


def one_panel(figure: Figure, filled: pd.DataFrame) -> Axes:
    """Axes for D of `filled`, double logarithmic."""
    axes = figure.subplots()
    axes.set(xscale="log", yscale="log", xlabel=r"$\omega t_0$", ylabel=DENSITY)
    axes.set(ylim=appearance.logarithmic_limits(filled["density"]))
    return axes


def draw_curves(figure: Figure, table: pd.DataFrame, column: str, label: Callable) -> Axes:
    """D for every value of a column in one panel; a line ends where a bin has no modes."""
    axes = one_panel(figure, table[table["modes"] > 0])
    table = table.assign(density=table["density"].where(table["modes"] > 0))
    for value, colour, marker in appearance.series(sorted(table[column].unique())):
        of = table[table[column] == value]
        axes.plot(of["omega"], of["density"], color=colour, linewidth=0.5)
        appearance.draw_spectrum(axes, of, "density", label(value), colour, marker, markersize=1.5)
    return axes
