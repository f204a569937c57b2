"""The rigidity G against k_T for several φ: A, Fig. 5.

Symbols: simulated step strain, or linear response where the study has no step strain, with standard
errors; lines: linear response; dashed lines: k_T = 0. The axis of k_T is logarithmic.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.rigidity_rows import COLUMNS, rigidity_rows
from grainmodes.figures.shared.selection import Options, choose_curves, positive_kts

__all__ = ["COLUMNS", "caption", "draw", "table"]

KINDS = {"theory": "g", "simulation": "g_simulated"}


def table(ensemble, options: Options) -> pd.DataFrame:
    """G and its standard error, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble has no k_T > 0, or lacks the requested n or phi.
    """
    positive_kts(ensemble["kt"].to_numpy(), "g_kt")
    rows = rigidity_rows(ensemble, KINDS, options.n)
    requested = None if options.phi is None else (options.phi,)
    return rows[rows["phi"].isin(choose_curves(requested, ensemble["phi"].to_numpy(), "phi"))]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Mean rigidity G against k_T/k_N, a colour per area fraction φ. Symbols: simulated step "
        "strain, or linear response where the study has no step strain; lines: linear response; "
        "dashed lines: grains without friction, k_T = 0. Bars: standard errors.",
        "the plateau at k_T/k_N ≤ 10⁻⁴ and its distance to the dashed line, which is the limit "
        "k_T → 0; the rise beyond has another shape at every φ.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a curve per φ."""
    axes = figure.subplots()
    phis = sorted(table["phi"].unique())
    for phi, colour, marker in list(appearance.curve_styles(phis))[::-1]:
        _curve(axes, table[table["phi"] == phi], colour, marker)
        appearance.add_to_legend(axes, labels.fraction(phi), colour, marker)
    axes.set(xscale="log", xlabel="$k_T / k_N$", ylabel=labels.modulus_label("$G$", table))
    axes.legend(title=r"$\phi$", loc="upper left", ncols=2)
    labels.write_caption(figure, table, note=_note(table))


def _note(table: pd.DataFrame) -> str:
    parts = ["symbols: simulation"] if "simulation" in set(table["kind"]) else ["symbols: theory"]
    parts += ["lines: theory"]
    parts += ["dashes: $k_T = 0$"] if (table["kt"] == 0).any() else []
    return ", ".join(parts)


def _curve(axes: Axes, rows: pd.DataFrame, colour, marker: str) -> None:
    theory, simulation = rows[rows["kind"] == "theory"], rows[rows["kind"] == "simulation"]
    for frictionless in theory.loc[theory["kt"] == 0, "rigidity"]:
        axes.axhline(frictionless, color=colour, linestyle="--", linewidth=0.6)
    theory, simulation = theory[theory["kt"] > 0], simulation[simulation["kt"] > 0]
    shown = theory if simulation.empty else simulation
    axes.plot(theory["kt"], theory["rigidity"], color=colour)
    axes.errorbar(shown["kt"], shown["rigidity"], shown["standard_error"], fmt=marker, color=colour)
