"""G against the distance to jamming at strong friction, with exponents: claim G4.

Double logarithmic: mean of G at every φ against the mean of φ − φ_J, for k_T = 0 and every
k_T/k_N ≥ 1, with standard errors. The legend has the exponent β of G ∝ (φ − φ_J)^β, the mean over
the seeds. Dashed lines: slopes 1/2 and 1.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble import contact_law
from grainmodes.ensemble.trends import exponent, jammed_values
from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import LAW, POINT, RIGIDITY_UNIT, law_values
from grainmodes.figures.shared.selection import Options, largest_or
from grainmodes.statistics.averages import average
from grainmodes.statistics.rounding import value_with_error

if TYPE_CHECKING:
    import xarray as xr

STRONG_KAPPA = 1.0
"""k_T/k_N from which on friction is strong."""

COLUMNS = {
    **LAW,
    **POINT,
    "distance": ("1", "mean over the jammed samples of phi - phi_J, phi_J that of the sample"),
    "rigidity": (RIGIDITY_UNIT, "mean of G over the jammed samples"),
    "standard_error": (RIGIDITY_UNIT, "standard error of the mean"),
    "samples": ("1", "number of jammed samples"),
    "exponent": ("1", "beta of G ~ (phi - phi_J)^beta at this k_T, mean over the seeds"),
    "exponent_error": ("1", "its standard error"),
}


def table(ensemble: xr.Dataset, options: Options) -> pd.DataFrame:
    """G, φ − φ_J and β at k_T = 0 and at strong friction, with the columns `COLUMNS`.

    Raises:
        ValueError: the ensemble lacks the requested n.
    """
    n = int(largest_or(options.n, _sizes(ensemble), "n"))
    kappas = [k for k in ensemble["kt"].to_numpy().tolist() if k == 0.0 or k >= STRONG_KAPPA]
    rows = [row for kappa in kappas for row in _rows(ensemble, n, kappa)]
    return pd.DataFrame(rows, columns=list(COLUMNS)).assign(**law_values(contact_law(ensemble)))


def _sizes(ensemble: xr.Dataset) -> np.ndarray:
    """The N with G at most area fractions."""
    known = ensemble["g"].notnull() & (ensemble["jammed"] == 1)
    points = known.any(["seed", "kt"]).sum("phi")
    return points["n"].to_numpy()[(points == points.max()).to_numpy()]


def _rows(ensemble: xr.Dataset, n: int, kappa: float) -> list[dict[str, float]]:
    moduli = jammed_values(ensemble, "g", n).sel(kt=kappa)
    distance = moduli["phi"] - jammed_values(ensemble, "phi_jamming", n).sel(kt=kappa)
    beta = exponent(ensemble, n, kappa)
    means = [average(rows.to_numpy(), np.isfinite(rows.to_numpy())) for rows in (moduli, distance)]
    columns = zip(moduli["phi"].to_numpy(), *means[0], means[1].mean, strict=True)
    return [
        {
            "n": n,
            "phi": phi,
            "kt": kappa,
            "distance": apart,
            "rigidity": mean,
            "standard_error": error,
            "samples": size,
            "exponent": beta.value,
            "exponent_error": beta.error,
        }
        for phi, mean, error, size, apart in columns
        if size > 0
    ]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    hidden = table.loc[table["rigidity"] <= 0.0, ["phi", "kt"]].to_numpy()
    named = ", ".join(f"φ = {phi:g} at k_T/k_N = {kt:g}" for phi, kt in hidden)
    without = f" Not drawn, because the mean is not positive: {named}." if named else ""
    return Caption(
        "Mean rigidity G against the mean distance to jamming, φ − φ_J with φ_J of each sample, a "
        "colour per k_T/k_N; in the legend the exponent β of G ∝ (φ − φ_J)^β, the mean over the "
        "seeds of the slope of log G. Dashed lines: slopes 1/2, that of the stiffness of a "
        f"Hertzian contact, and 1. Bars: standard errors.{without}",
        "the slopes: near 1 without friction, one and the same between 1/2 and 1 at every "
        "k_T/k_N ≥ 1; whether a curve is straight, or steeper near jamming.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw a curve per k_T."""
    table = table[table["rigidity"] > 0.0]
    if table.empty:
        labels.say_empty(figure, ["No mean of G is positive."])
        return
    axes = figure.subplots()
    for kt, colour, marker in appearance.curve_styles(sorted(table["kt"].unique())):
        _curve(axes, table[table["kt"] == kt], kt, colour, marker)
    _slopes(axes, table)
    axes.set(yscale="log", xlabel=r"$\phi - \phi_J$")
    axes.set_ylabel(labels.modulus_label("$G$", table))
    appearance.scale_logarithmically(axes)
    axes.legend(title=r"$k_T / k_N$", loc="lower right")
    labels.write_caption(figure, table)


def _curve(axes: Axes, curve: pd.DataFrame, kt: float, colour: tuple, marker: str) -> None:
    bars = appearance.logarithmic_bars(
        curve["rigidity"].to_numpy(), curve["standard_error"].to_numpy()
    )
    axes.errorbar(curve["distance"], curve["rigidity"], bars, fmt=f"{marker}-", color=colour)
    value, error = curve[["exponent", "exponent_error"]].iloc[0]
    known = np.isfinite(value)
    beta = rf": $\beta = {value_with_error(value, error)}$" if known else ""
    appearance.add_to_legend(axes, f"${labels.ratio(kt)}${beta}", colour, marker)


def _slopes(axes: Axes, table: pd.DataFrame) -> None:
    """Dashed lines of slopes 1/2 and 1 over the range of the data."""
    ends = np.array([table["distance"].min(), table["distance"].max()])
    for kt, slope in ((table["kt"].max(), 0.5), (table["kt"].min(), 1.0)):
        last = table[table["kt"] == kt].nlargest(1, "distance")
        height = float(last["rigidity"].iloc[0]) * (ends / float(last["distance"].iloc[0])) ** slope
        axes.plot(ends, height, "--", color="0.5", linewidth=0.8)
