"""The rigidity G against φ for several k_T: A, Fig. 4.

Open symbols: linear response; dots: simulated step strain. Bars are standard errors.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.rigidity_rows import COLUMNS, rigidity_rows_at_kts
from grainmodes.figures.shared.selection import Options

__all__ = ["COLUMNS", "caption", "draw", "table"]

KINDS = {"theory": "g", "simulation": "g_simulated"}
NOTE = "open symbols: theory, dots: simulation"
LARGEST_SIZE, SMALLEST_SIZE, DOT_SIZE = 8.5, 6.5, 1.7
"""Sizes of symbols: open ones shrink with k_T, so that those which coincide stay visible."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """G and its standard error, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble lacks the requested n or kt.
    """
    return rigidity_rows_at_kts(ensemble, KINDS, options)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Mean rigidity G against the area fraction φ, a colour per k_T/k_N. Open symbols: linear "
        "response, A (39); dots: simulated step strain, A (16), where the study has it. Bars: "
        "standard errors; a sample that is not jammed counts as G = 0.",
        "whether every dot lies in the middle of its open symbol, so that theory is simulation; "
        "whether the curves of k_T/k_N ≤ 10⁻⁴ coincide; and whether G is proportional to φ − φ_c "
        "at large k_T/k_N.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a curve per k_T."""
    axes = figure.subplots()
    kts = sorted(table["kt"].unique())
    for index, (kt, colour, marker) in enumerate(appearance.curve_styles(kts)):
        size = LARGEST_SIZE - (LARGEST_SIZE - SMALLEST_SIZE) * index / max(1, len(kts) - 1)
        rows = table[table["kt"] == kt]
        theory, simulation = rows[rows["kind"] == "theory"], rows[rows["kind"] == "simulation"]
        _points(axes, theory, fmt=marker, color=colour, markersize=size, mfc="none", mew=0.6)
        _points(axes, simulation, fmt="o", color=colour, markersize=DOT_SIZE)
        appearance.add_to_legend(axes, f"${labels.ratio(kt)}$", colour, marker, mfc="none")
    axes.set(xlabel=r"$\phi$", ylabel=labels.modulus_label("$G$", table))
    axes.legend(title="$k_T / k_N$", loc="best", ncols=2)
    simulated = "simulation" in set(table["kind"])
    labels.write_caption(figure, table, note=NOTE if simulated else "")


def _points(axes: Axes, rows: pd.DataFrame, **style) -> None:
    axes.errorbar(rows["phi"], rows["rigidity"], rows["standard_error"], **style)
