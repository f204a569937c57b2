"""Where the non-affine rigidity of an unloaded step changes its sign: claim G1.

(a) G_NA against k_T/k_N at every φ, with standard errors. (b) κ*, the k_T/k_N at which the mean of
G_NA rises through 0, against φ, with errors of the jackknife; dashed: A's value, 2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble import contact_law
from grainmodes.ensemble.trends import crossing_samples, sign_change
from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import LAW, POINT, RIGIDITY_UNIT, law_values
from grainmodes.figures.shared.selection import Options, largest_or
from grainmodes.statistics.averages import average
from grainmodes.statistics.estimates import Estimate

if TYPE_CHECKING:
    import xarray as xr

PAPER_CROSSING = 2.0
"""κ* of paper A."""

LOWEST_KAPPA = 0.05
"""Smallest k_T/k_N that panel (a) shows."""

EMPTY = f"no jammed sample at a k_T/k_N of at least {LOWEST_KAPPA}"

COLUMNS = {
    **LAW,
    **POINT,
    "rigidity": (RIGIDITY_UNIT, "mean of G_NA over the jammed samples, unloaded step"),
    "standard_error": (RIGIDITY_UNIT, "standard error of the mean"),
    "samples": ("1", "number of jammed samples"),
    "crossing": ("1", "k_T / k_N at which the mean of G_NA rises through 0 at this phi"),
    "crossing_error": ("1", "its standard error (jackknife over the seeds)"),
}


def table(ensemble: xr.Dataset, options: Options) -> pd.DataFrame:
    """G_NA from `LOWEST_KAPPA` on and κ* of every φ, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble lacks the requested n.
    """
    n = int(largest_or(options.n, _sizes(ensemble), "n"))
    rows = [row for phi in ensemble["phi"].to_numpy().tolist() for row in _rows(ensemble, n, phi)]
    found = pd.DataFrame(rows, columns=list(COLUMNS)).assign(**law_values(contact_law(ensemble)))
    return found[found["kt"] >= LOWEST_KAPPA]


def _sizes(ensemble: xr.Dataset) -> np.ndarray:
    """The N with G_NA at most points."""
    known = ensemble["g_nonaffine"].notnull() & (ensemble["jammed"] == 1)
    points = known.any("seed").sum(["phi", "kt"])
    return points["n"].to_numpy()[(points == points.max()).to_numpy()]


def _rows(ensemble: xr.Dataset, n: int, phi: float) -> list[dict[str, float]]:
    kappas, samples = crossing_samples(ensemble, n, phi)
    zero = sign_change(ensemble, n, phi) or Estimate(np.nan, np.nan, 0)
    found = average(samples.T, np.isfinite(samples.T))
    columns = zip(kappas, found.mean, found.standard_error, found.samples, strict=True)
    return [
        {
            "n": n,
            "phi": phi,
            "kt": kappa,
            "rigidity": mean,
            "standard_error": error,
            "samples": size,
            "crossing": zero.value,
            "crossing_error": zero.error,
        }
        for kappa, mean, error, size in columns
    ]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "(a) Mean non-affine rigidity G_NA of a step that does not load the tangential springs, "
        "against k_T/k_N, a colour per area fraction φ. (b) The k_T/k_N at which it changes its "
        "sign, κ*, against φ; dashed: 2, which paper A finds on a grid of 1, 2 and 5. Bars: "
        "standard errors, in (b) by the jackknife over the seeds.",
        "κ* in (b): whether it falls with φ, and how far it is from 2.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw G_NA against k_T beside κ* against φ."""
    figure.set_size_inches(7.0, 3.0)
    left, right = figure.subplots(1, 2)
    _curves(left, table)
    _crossings(right, table.drop_duplicates("phi"))
    labels.name_panel(left, 0, r"unloaded $G_{\rm NA}$")
    labels.name_panel(right, 1, "change of sign")
    labels.write_caption(figure, table)


def _curves(axes: Axes, table: pd.DataFrame) -> None:
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    for phi, colour, marker in appearance.curve_styles(sorted(table["phi"].unique())):
        curve = table[table["phi"] == phi]
        style = {"fmt": f"{marker}-", "color": colour}
        axes.errorbar(curve["kt"], curve["rigidity"], curve["standard_error"], **style)
        appearance.add_to_legend(axes, labels.fraction(phi), colour, marker)
    axes.set(xscale="log", xlabel="$k_T / k_N$")
    axes.set_ylabel(labels.modulus_label(r"$G_{\rm NA}$", table))
    axes.legend(title=r"$\phi$", loc="upper left", ncols=2)


def _crossings(axes: Axes, table: pd.DataFrame) -> None:
    axes.axhline(PAPER_CROSSING, color="0.5", linestyle="--", linewidth=0.8)
    axes.errorbar(table["phi"], table["crossing"], table["crossing_error"], fmt="o-", color="k")
    axes.set(xlabel=r"$\phi$", ylabel=r"$\kappa^*$, $k_T / k_N$ at $G_{\rm NA} = 0$")
