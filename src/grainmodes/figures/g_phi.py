"""G against phi for several k_T: theory and simulation (A, Fig. 4)."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures import appearance
from grainmodes.figures.rigidity_rows import COLUMNS, rows
from grainmodes.figures.selection import Options, curves, largest_or

__all__ = ["COLUMNS", "draw", "table"]

KINDS = {"theory": "g", "simulation": "g_simulated"}
LARGEST, SMALLEST, DOT = 8.5, 6.5, 1.7
"""Sizes of symbols: open ones shrink with k_T, so that those which coincide are seen."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """G and its standard error, with the columns `COLUMNS`."""
    found = rows(ensemble, KINDS, largest_or(options.n, ensemble["n"].to_numpy(), "n"))
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
    axes.set(xlabel=r"$\phi$", ylabel=f"$G$ / ({appearance.MODULUS})")
    axes.add_artist(axes.legend(title="$k_T / k_N$", loc="upper left", ncols=2))
    appearance.write_caption(figure, table)
    _explain_symbols(axes, "simulation" in set(table["kind"]))


def _points(axes: Axes, of: pd.DataFrame, colour, marker: str, **style) -> None:
    axes.errorbar(
        of["phi"], of["rigidity"], of["standard_error"], fmt=marker, color=colour, **style
    )


def _explain_symbols(axes: Axes, simulated: bool) -> None:
    shown = len(axes.get_legend_handles_labels()[1])
    appearance.add_to_legend(axes, "theory", "0.3", "o", markersize=6, mfc="none")
    if simulated:
        appearance.add_to_legend(axes, "simulation", "0.3", "o", markersize=DOT)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[shown:], labels[shown:], loc="lower right")
