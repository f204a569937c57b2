"""The non-affine rigidity G_NA against φ for several k_T: A, Fig. 6.

Left: A's step strain, which does not load the tangential springs; there G_NA > 0 for k_T > 2 k_N.
Right: a step strain that loads them, as continuous shear does; there
G_NA = -a^T J^+ a / L^2 <= 0 at every k_T. Bars are standard errors.
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

KINDS = {"unloaded": "g_nonaffine", "loaded": "g_nonaffine_loaded"}
LINEAR_RANGE = 0.02
"""|G_NA| up to which the axis of the loaded panel is linear; above, it is logarithmic."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """G_NA and its standard error, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble lacks the requested n or kt.
    """
    return rigidity_rows_at_kts(ensemble, KINDS, options)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Mean non-affine rigidity G_NA against the area fraction φ, a colour per k_T/k_N. (a) A's "
        "step strain, which does not load the tangential springs; (b) a step strain that loads "
        "them, as continuous shear does, where G_NA = −aᵀJ⁺a/L² ≤ 0; its axis is linear up to "
        "0.02 and logarithmic beyond. Bars: standard errors.",
        "the sign in (a), which changes with k_T/k_N and not in (b); whether |G_NA| grows with φ.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw two panels, each with its own axis, as the loaded values are a hundred times larger."""
    figure.set_size_inches(7.0, 3.0)
    panels = figure.subplots(1, 2)
    for index, (axes, kind) in enumerate(zip(panels, KINDS, strict=True)):
        _panel(axes, table[table["kind"] == kind])
        labels.name_panel(axes, index, f"{kind} step strain")
    entries = panels[0].get_legend_handles_labels()
    figure.legend(*entries, title="$k_T / k_N$", loc="outside right center")
    panels[1].set_yscale("symlog", linthresh=LINEAR_RANGE)
    labels.write_caption(figure, table)


def _panel(axes: Axes, rows: pd.DataFrame) -> None:
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    for kt, colour, marker in appearance.curve_styles(sorted(rows["kt"].unique())):
        curve = rows[rows["kt"] == kt]
        style = {"fmt": marker + "-", "color": colour}
        axes.errorbar(curve["phi"], curve["rigidity"], curve["standard_error"], **style)
        appearance.add_to_legend(axes, f"${labels.ratio(kt)}$", colour, marker)
    axes.set(xlabel=r"$\phi$", ylabel=labels.modulus_label(r"$G_{\rm NA}$", rows))
