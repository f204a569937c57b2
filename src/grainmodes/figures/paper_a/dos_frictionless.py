"""D(omega) at a small k_T against grains without friction, both over 3N (A, Fig. 11)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared import appearance, spectral_rows
from grainmodes.figures.shared.panels import one_panel
from grainmodes.figures.shared.selection import Options, positive, weak
from grainmodes.figures.shared.spectral_points import ANY, place

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {"kind": ("-", "frictional, or frictionless: without rotation, k_T = 0")}
)

STYLES = {
    "frictional": {"colour": appearance.TRANSLATIONAL, "marker": "o"},
    "frictionless": {"label": "frictionless", "colour": appearance.ROTATIONAL, "marker": "^"}
    | appearance.OPEN,
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """D of both in the same bins, with the columns `COLUMNS`.

    Raises:
        ValueError: no N and phi have spectra both with and without friction.
    """
    present = points_with(ensemble, *ANY)
    present &= present.where(present["kt"] == 0, False).any("kt")
    if not (present & (present["kt"] > 0)).any():
        raise ValueError("figure dos_frictionless: no N and phi have spectra at k_T = 0 and above")
    n, phi, kappas = place(options, present)
    kappa = weak(options.kt, positive(kappas, "dos_frictionless"))
    kinds = {"frictional": ((n, phi, kappa), ""), "frictionless": ((n, phi, 0.0), "")}
    return spectral_rows.compared(ensemble, options, kinds)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Double logarithmic; a bin without modes has no symbol."""
    filled = table[table["modes"] > 0]
    label = f"$k_T / k_N = {appearance.power(table['kt'].max())}$"
    styles = STYLES | {"frictional": STYLES["frictional"] | {"label": label}}
    axes = one_panel(figure, filled)
    appearance.draw_kinds(axes, filled, "density", styles)
    axes.legend()
    appearance.write_caption(figure, table, ("n", "phi"))
