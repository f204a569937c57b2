"""G against k_T for several phi: simulation, and theory as a line (A, Fig. 5)."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.rigidity_rows import COLUMNS, rows
from grainmodes.figures.shared.selection import Options, curves, positive

__all__ = ["COLUMNS", "draw", "table"]

KINDS = {"theory": "g", "simulation": "g_simulated"}


def table(ensemble, options: Options) -> pd.DataFrame:
    """G and its standard error, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble has no k_T > 0.
    """
    positive(ensemble["kt"].to_numpy(), "g_kt")
    found = rows(ensemble, KINDS, options.n)
    asked = None if options.phi is None else (options.phi,)
    return found[found["phi"].isin(curves(asked, ensemble["phi"].to_numpy(), "phi"))]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Symbols: simulation (theory where there is none); lines: theory; dashes: k_T = 0."""
    axes = figure.subplots()
    phis = sorted(table["phi"].unique())
    for phi, colour, marker in list(appearance.series(phis))[::-1]:
        _curve(axes, table[table["phi"] == phi], colour, marker)
        appearance.add_to_legend(axes, appearance.fraction(phi), colour, marker)
    axes.set(xscale="log", xlabel="$k_T / k_N$", ylabel=appearance.modulus_label("$G$", table))
    axes.legend(title=r"$\phi$", loc="upper left", ncols=2)
    appearance.write_caption(figure, table, note=_note(table))


def _note(table: pd.DataFrame) -> str:
    parts = ["symbols: simulation"] if "simulation" in set(table["kind"]) else ["symbols: theory"]
    parts += ["lines: theory"]
    parts += ["dashes: $k_T = 0$"] if (table["kt"] == 0).any() else []
    return ", ".join(parts)


def _curve(axes: Axes, of: pd.DataFrame, colour, marker: str) -> None:
    theory, simulation = of[of["kind"] == "theory"], of[of["kind"] == "simulation"]
    for frictionless in theory.loc[theory["kt"] == 0, "rigidity"]:
        axes.axhline(frictionless, color=colour, linestyle="--", linewidth=0.6)
    theory, simulation = theory[theory["kt"] > 0], simulation[simulation["kt"] > 0]
    shown = theory if simulation.empty else simulation
    axes.plot(theory["kt"], theory["rigidity"], color=colour)
    axes.errorbar(shown["kt"], shown["rigidity"], shown["standard_error"], fmt=marker, color=colour)
