"""G against phi for several k_T: theory and simulation (A, Fig. 4)."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.rigidity_rows import COLUMNS, rows
from grainmodes.figures.shared.selection import Options, curves

__all__ = ["COLUMNS", "draw", "table"]

KINDS = {"theory": "g", "simulation": "g_simulated"}
SYMBOLS = "open symbols: theory, dots: simulation"
LARGEST, SMALLEST, DOT = 8.5, 6.5, 1.7
"""Sizes of symbols: open ones shrink with k_T, so that those which coincide are seen."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """G and its standard error, with the columns `COLUMNS`."""
    found = rows(ensemble, KINDS, options.n)
    return found[found["kt"].isin(curves(options.kt, ensemble["kt"].to_numpy(), "kt"))]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Open symbols: theory; dots: simulation."""
    axes = figure.subplots()
    kappas = sorted(table["kt"].unique())
    for index, (kappa, colour, marker) in enumerate(appearance.series(kappas)):
        size = LARGEST - (LARGEST - SMALLEST) * index / max(1, len(kappas) - 1)
        of = table[table["kt"] == kappa]
        _points(
            axes, of[of["kind"] == "theory"], colour, marker, markersize=size, mfc="none", mew=0.6
        )
        _points(axes, of[of["kind"] == "simulation"], colour, "o", markersize=DOT)
        appearance.add_to_legend(axes, f"${appearance.power(kappa)}$", colour, marker, mfc="none")
    axes.set(xlabel=r"$\phi$", ylabel=appearance.modulus_label("$G$", table))
    axes.legend(title="$k_T / k_N$", loc="best", ncols=2)
    simulated = "simulation" in set(table["kind"])
    appearance.write_caption(figure, table, note=SYMBOLS if simulated else "")


def _points(axes: Axes, of: pd.DataFrame, colour, marker: str, **style) -> None:
    axes.errorbar(
        of["phi"], of["rigidity"], of["standard_error"], fmt=marker, color=colour, **style
    )
