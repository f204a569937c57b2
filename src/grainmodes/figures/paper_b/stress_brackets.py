"""Stress against strain with events bracketed and not, in one sample (B, Fig. 2).

Both curves on the grid of Δγ_in; the lower panel shows what they differ by.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble.reading import variable
from grainmodes.figures.shared.appearance import ROTATIONAL
from grainmodes.figures.shared.rigidity_rows import UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_points import SAMPLE, name_sample, sample

COLUMNS = SAMPLE | {
    "strain": ("1", "strain γ"),
    "bracketed": (UNIT, "stress (sigma_xy + sigma_yx) / 2, every event bracketed to Δγ_Th"),
    "coarse_run": (UNIT, "the same of a shear in steps of Δγ_in alone"),
}

SAME = 1e-12
"""Strains that are the same may differ by so much."""

FLOOR = 1e-12
"""Smallest difference drawn: less is rounding."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """Both stresses of one sample, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves, or none without brackets.
        ValueError: no curve lies at the n, phi, kt or seed asked for.
    """
    curve, rows = sample(ensemble, options, COLUMNS)
    if curve is None:
        return rows
    place = {name: rows[name].iloc[0] for name in ("n", "phi", "kt", "seed")}
    strain, stress = (
        variable(ensemble, f"coarse_{name}").sel(place).to_numpy() for name in ("strain", "stress")
    )
    known = np.isfinite(strain) & (strain <= curve.strain[-1] + SAME)
    rows = rows.iloc[: np.count_nonzero(known)].copy()
    at = np.searchsorted(curve.strain, strain[known] - SAME)
    return rows.assign(
        strain=strain[known], bracketed=curve.stress[at], coarse_run=stress[known]
    ).reset_index(drop=True)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Broad line: bracketed; thin: not; below, the difference."""
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    above.plot(
        table["strain"], table["bracketed"], color=ROTATIONAL, lw=2.4, label="events bracketed"
    )
    above.plot(table["strain"], table["coarse_run"], color="0.1", lw=0.6, label="in steps alone")
    above.set(ylabel=r"$\sigma\,/\,k_N$")
    above.legend()
    difference = np.abs(table["coarse_run"] - table["bracketed"])
    below.semilogy(table["strain"], difference.clip(lower=FLOOR), color="0.3", lw=0.8)
    below.set(xlabel=r"$\gamma$", ylabel=r"difference$\,/\,k_N$")
    figure.align_ylabels()
    name_sample(figure, table, "the same sample with its events bracketed and not")
