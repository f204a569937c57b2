"""G_NA against phi for several k_T, unloaded beside loaded step strain (A, Fig. 6).

A's step strain does not load the tangential springs; there G_NA > 0 for k_T > 2 k_N. Loaded, as
under continuous shear, G_NA = -a^T J^+ a / L^2 <= 0 at every k_T.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.rigidity_rows import COLUMNS, rows
from grainmodes.figures.shared.selection import Options, curves

__all__ = ["COLUMNS", "draw", "table"]

KINDS = {"unloaded": "g_nonaffine", "loaded": "g_nonaffine_loaded"}
LINEAR_BELOW = 0.02
"""|G_NA| up to which the axis of the loaded panel is linear; above, it is logarithmic."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """G_NA and its standard error, with the columns `COLUMNS`."""
    found = rows(ensemble, KINDS, options.n)
    return found[found["kt"].isin(curves(options.kt, ensemble["kt"].to_numpy(), "kt"))]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Two panels with an axis of G_NA each, as the loaded values are a hundred times larger."""
    figure.set_size_inches(7.0, 3.0)
    panels = figure.subplots(1, 2)
    for index, (axes, kind) in enumerate(zip(panels, KINDS, strict=True)):
        _panel(axes, table[table["kind"] == kind])
        appearance.name_panel(axes, index, f"{kind} step strain")
    entries = panels[0].get_legend_handles_labels()
    figure.legend(*entries, title="$k_T / k_N$", loc="outside right center")
    panels[1].set_yscale("symlog", linthresh=LINEAR_BELOW)
    appearance.write_caption(figure, table)


def _panel(axes: Axes, of: pd.DataFrame) -> None:
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    for kappa, colour, marker in appearance.series(sorted(of["kt"].unique())):
        at = of[of["kt"] == kappa]
        axes.errorbar(
            at["phi"], at["rigidity"], at["standard_error"], fmt=marker + "-", color=colour
        )
        appearance.add_to_legend(axes, f"${appearance.power(kappa)}$", colour, marker)
    axes.set(xlabel=r"$\phi$", ylabel=appearance.modulus_label(r"$G_{\rm NA}$", of))
