"""The density of states at a small k_T beside that of grains without friction: A, Fig. 11.

Both in the same bins and over 3N. Filled circles: with friction, at the k_T of the legend; open
triangles: without friction, where grains have no rotations.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared import appearance, labels, spectral_rows
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.selection import Options, choose_weak, positive_kts
from grainmodes.figures.shared.spectral_panels import draw_kinds, one_density_panel
from grainmodes.figures.shared.spectral_points import SPECTRUM_VARIABLES, choose_points

COLUMNS = (
    spectral_rows.BINS
    | spectral_rows.DENSITY
    | {"kind": ("-", "frictional, or frictionless: without rotation, k_T = 0")}
)

STYLES = {
    "frictional": {"colour": appearance.TRANSLATIONAL, "marker": "o"},
    "frictionless": {"label": "frictionless", "colour": appearance.ROTATIONAL, "marker": "^"}
    | appearance.OPEN_SYMBOLS,
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """D of both in the same bins, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: no N and phi have spectra both with and without friction, or not at the
            requested n, phi or kt.
    """
    present = points_with(ensemble, *SPECTRUM_VARIABLES)
    present &= present.where(present["kt"] == 0, False).any("kt")
    if not (present & (present["kt"] > 0)).any():
        raise ValueError("figure dos_frictionless: no N and phi have spectra at k_T = 0 and above")
    n, phi, kts = choose_points(options, present)
    kt = choose_weak(options.one_kt(), positive_kts(kts, "dos_frictionless"))
    kinds = {"frictional": ((n, phi, kt), ""), "frictionless": ((n, phi, 0.0), "")}
    return spectral_rows.compare_spectra(ensemble, options, kinds)[list(COLUMNS)]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Density of states D(ω) with weak friction (red filled circles) and without friction "
        "(blue open triangles), in the same bins and both divided by 3N. Grains without friction "
        "have no rotations. Double logarithmic; bars: standard errors over the samples, as long "
        "below as above.",
        "the translational band, which is the same for both, and the rotational band, which only "
        "grains with friction have.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both in one panel, double logarithmic."""
    filled = table[table["modes"] > 0]
    label = f"$k_T / k_N = {labels.power(table['kt'].max())}$"
    styles = STYLES | {"frictional": STYLES["frictional"] | {"label": label}}
    axes = one_density_panel(figure, filled)
    draw_kinds(axes, filled, "density", styles)
    axes.legend()
    labels.write_caption(figure, table, ("n", "phi"))
