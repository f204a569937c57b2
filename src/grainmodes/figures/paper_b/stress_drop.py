"""Smallest eigenvalue λ_min, rigidity g and stress σ around the largest stress drop: B, Fig. 3.

(a) λ_min, (b) g (open symbols) and σ (dots, right axis) of the states of the shear, whose steps
become shorter towards the event. Of all samples that with the largest drop is shown.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.curves import Curve
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import RED, ROTATIONAL
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_samples import SAMPLE, one_curve

if TYPE_CHECKING:
    import xarray as xr

COLUMNS = SAMPLE | {
    "distance": ("1", "strain of a state minus that of the event"),
    "strain": ("1", "strain of a state"),
    "lowest_eigenvalue": (RIGIDITY_UNIT, "smallest eigenvalue of the Jacobian but translations"),
    "rigidity": (RIGIDITY_UNIT, "(g_xy + g_yx) / 2 by linear response"),
    "stress": (RIGIDITY_UNIT, "(sigma_xy + sigma_yx) / 2 in the simulation"),
}
STEPS_AROUND = 2.5
"""Steps Δγ_in on either side of the event, as in B: γ_c ± 2.5e-4."""


def table(ensemble: xr.Dataset, options: Options) -> pd.DataFrame:
    """The states around the largest drop of σ, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the requested n, phi, kt or seed.
    """
    curve, rows = one_curve(ensemble, options, COLUMNS, prefer=_largest_drop)
    if curve is None or not curve.event.any():
        return rows.iloc[:0]
    last = int(np.argmin(np.where(curve.event, curve.stress_change, np.inf)))
    rows = rows.assign(
        distance=curve.strain - curve.strain[last : last + 2].mean(),
        strain=curve.strain,
        lowest_eigenvalue=curve.lowest_eigenvalue,
        rigidity=curve.modulus,
        stress=curve.stress,
    )
    return rows[rows["distance"].abs() <= STEPS_AROUND * curve.longest_step]


def _largest_drop(curve: Curve) -> float:
    return float(-curve.stress_change[curve.event].min(initial=0.0))


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "States of a shear around the largest drop of the stress of all samples, at γ_c (red "
        "line), which steps that become shorter have bracketed: (a) smallest eigenvalue λ_min of "
        "the Jacobian, (b) rigidity g by linear response (open symbols, left axis) and stress σ "
        "of the simulation (dots, right axis).",
        "whether λ_min falls and g diverges before the drop, which would be precursors, or both "
        "jump at it.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw λ_min above; g and σ below, on one axis of strain."""
    figure.set_size_inches(3.7, 4.4)
    upper, lower = figure.subplots(2, 1, sharex=True)
    open_style = {"color": ROTATIONAL, "mfc": "none", "mew": 0.7, "markersize": 4.5}
    x = 1e4 * table["distance"]
    if table["lowest_eigenvalue"].isna().all():
        upper.text(0.5, 0.5, "not computed", transform=upper.transAxes, ha="center", va="center")
    upper.plot(x, table["lowest_eigenvalue"], "o", **open_style)
    upper.set(ylabel=labels.modulus_label(r"$\lambda_{\min}$", table))
    lower.plot(x, table["rigidity"], "o", **open_style, label="$g$")
    lower.set_xlabel(r"$(\gamma - \gamma_c) \times 10^4$")
    lower.set_ylabel(labels.modulus_label("$g$", table), color=ROTATIONAL)
    right = lower.twinx()
    right.plot(x, table["stress"], "o", color="0.15", markersize=2.2, mew=0, label=r"$\sigma$")
    right.set_ylabel(labels.modulus_label(r"$\sigma$", table))
    titles = ("smallest eigenvalue", "rigidity (open) and stress (dots)")
    for index, (axes, title) in enumerate(zip((upper, lower), titles, strict=True)):
        _mark_event(axes)
        labels.name_panel(axes, index, title)
        axes.margins(y=0.15)
    critical = (table["strain"] - table["distance"]).iloc[0]
    note = rf"largest drop of $\sigma$, $\gamma_c = {critical:.8f}$"
    figure.suptitle(f"{labels.sample_caption(table)}\n{note}")


def _mark_event(axes: Axes) -> None:
    axes.axvline(0.0, color=RED, linewidth=0.6, zorder=0)
