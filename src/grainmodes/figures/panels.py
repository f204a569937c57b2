"""A grid of panels, one per k_T, on common axes."""

from __future__ import annotations

from collections.abc import Callable

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures import appearance


def draw_panels(
    figure: Figure, table: pd.DataFrame, ordinate: str, draw: Callable[[Axes, pd.DataFrame], None]
) -> list[Axes]:
    """Draw the rows of each k_T over a logarithmic axis of omega, two panels side by side.

    Args:
        ordinate: label of the vertical axis.
        draw: draws the rows of one k_T into a panel.

    Returns:
        the panels, ascending in k_T.
    """
    kappas = sorted(table["kt"].unique())
    columns = min(2, len(kappas))
    lines = -(-len(kappas) // columns)
    figure.set_size_inches(3.5 * columns, 0.4 + 2.4 * lines)
    grid = figure.subplots(lines, columns, squeeze=False, sharex=True, sharey=True).ravel()
    for index, (axes, kappa) in enumerate(zip(grid, kappas, strict=False)):
        draw(axes, table[table["kt"] == kappa])
        appearance.name_panel(axes, index, f"$k_T / k_N = {appearance.power(kappa)}$")
        axes.set(xscale="log", xlabel=r"$\omega t_0$", ylabel=ordinate)
    for axes in grid[: len(kappas)]:
        axes.label_outer()
    for axes in grid[len(kappas) :]:
        axes.set_visible(False)
    appearance.write_caption(figure, table, phi=table["phi"].iloc[0])
    return list(grid[: len(kappas)])
