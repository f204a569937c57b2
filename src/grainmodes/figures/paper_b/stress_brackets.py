"""Stress against strain with events bracketed and without brackets, in one sample: B, Fig. 2.

Above both curves at the strains of the coarse steps Δγ_in: broad line with brackets, thin line
without. Below the absolute difference of the two.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble.reading import variable
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import ROTATIONAL
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_samples import SAMPLE, one_curve

COLUMNS = SAMPLE | {
    "strain": ("1", "strain γ"),
    "bracketed": (
        RIGIDITY_UNIT,
        "stress (sigma_xy + sigma_yx) / 2, every event bracketed to Δγ_Th",
    ),
    "coarse_run": (RIGIDITY_UNIT, "the same of a shear in steps of Δγ_in alone"),
}

STRAIN_TOLERANCE = 1e-12
"""Difference up to which two strains count as equal."""

SMALLEST_DIFFERENCE = 1e-12
"""Smallest difference of stresses that is drawn; smaller ones are rounding errors."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """Both stresses of one sample, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves, or none without brackets.
        ValueError: no curve lies at the requested n, phi, kt or seed.
    """
    curve, rows = one_curve(ensemble, options, COLUMNS)
    if curve is None:
        return rows
    sample = {name: rows[name].iloc[0] for name in ("n", "phi", "kt", "seed")}
    strain, stress = (
        variable(ensemble, f"coarse_{name}").sel(sample).to_numpy() for name in ("strain", "stress")
    )
    known = np.isfinite(strain) & (strain <= curve.strain[-1] + STRAIN_TOLERANCE)
    rows = rows.iloc[: np.count_nonzero(known)].copy()
    state = np.searchsorted(curve.strain, strain[known] - STRAIN_TOLERANCE)
    return rows.assign(
        strain=strain[known], bracketed=curve.stress[state], coarse_run=stress[known]
    ).reset_index(drop=True)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Shear stress against strain of one sample, sheared twice: with every plastic event "
        "bracketed to Δγ_Th (broad line) and in steps Δγ_in alone (thin line); below, the "
        "absolute difference of the two.",
        "the strain up to which the difference stays small, and the events at which the two part.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both curves, and their difference below them."""
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    above.plot(
        table["strain"], table["bracketed"], color=ROTATIONAL, lw=2.4, label="events bracketed"
    )
    above.plot(table["strain"], table["coarse_run"], color="0.1", lw=0.6, label="in steps alone")
    above.set(ylabel=r"$\sigma\,/\,k_N$")
    above.legend()
    difference = np.abs(table["coarse_run"] - table["bracketed"])
    difference = difference.clip(lower=SMALLEST_DIFFERENCE)
    below.semilogy(table["strain"], difference, color="0.3", lw=0.8)
    below.set(xlabel=r"$\gamma$", ylabel=r"difference$\,/\,k_N$")
    figure.align_ylabels()
    labels.write_sample_caption(figure, table, "the same sample with its events bracketed and not")
