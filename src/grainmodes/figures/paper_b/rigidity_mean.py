"""Mean rigidity of the samples against strain: B, Fig. 9.

Line: linear response; symbols with standard errors: slope of the simulated stress, without the
steps in which a plastic event lies.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble.curves import even_bins
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import ROTATIONAL
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_samples import POINT, curves_at_point
from grainmodes.statistics import averages

MAX_BINS = 50
"""Number of bins over all strains; fewer where no curve has so many steps."""

COLUMNS = POINT | {
    "kind": ("-", "theory or simulation"),
    "strain": ("1", "middle of a bin of strain"),
    "rigidity": (
        RIGIDITY_UNIT,
        "mean over the samples of g, or of the slope of the stress but in events",
    ),
    "standard_error": (RIGIDITY_UNIT, "standard error of the mean"),
    "samples": ("1", "number of samples"),
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """Both mean rigidities in bins of strain, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the requested n, phi or kt.
    """
    point, found = curves_at_point(ensemble, options)
    curves = [curve for curve in found.values() if len(curve.step)]
    if not curves:
        return pd.DataFrame(columns=list(COLUMNS))
    edges = even_bins(curves, min(MAX_BINS, max(len(curve.step) for curve in curves)))
    slopes = {
        "theory": [curve.mean_slopes(curve.predicted_change, edges) for curve in curves],
        "simulation": [curve.mean_slopes(curve.stress_change, edges) for curve in curves],
    }
    parts = [_means(kind, np.array(values), edges) for kind, values in slopes.items()]
    rows = pd.concat(parts, ignore_index=True).assign(**point)[list(COLUMNS)]
    return rows[rows["samples"] > 0].reset_index(drop=True)


def _means(kind: str, slopes: np.ndarray, edges: np.ndarray) -> pd.DataFrame:
    """Means over the samples of slopes (S, B) in bins."""
    means = averages.average(slopes.T, np.ones(slopes.T.shape, dtype=bool))
    return pd.DataFrame(
        {
            "kind": kind,
            "strain": (edges[1:] + edges[:-1]) / 2.0,
            "rigidity": means.mean,
            "standard_error": means.standard_error,
            "samples": means.samples,
        }
    )


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Mean rigidity G over the samples against strain γ, in bins of strain. Line: linear "
        "response; symbols: slope of the simulated stress, steps with a plastic event left out; "
        "bars: standard errors.",
        "whether the line runs through the symbols at every strain.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both in one panel."""
    axes = figure.subplots()
    theory, simulation = (table[table["kind"] == kind] for kind in ("theory", "simulation"))
    axes.plot(theory["strain"], theory["rigidity"], color=ROTATIONAL, label="theory", zorder=3)
    axes.errorbar(
        simulation["strain"],
        simulation["rigidity"],
        simulation["standard_error"],
        fmt="o",
        color="0.15",
        markersize=2.5,
        mew=0,
        elinewidth=0.6,
        label="simulation",
    )
    axes.set(xlabel=r"$\gamma$", ylabel=labels.modulus_label("$G$", table))
    axes.legend()
    labels.write_caption(figure, table, ("n", "phi", "kt"), "steps with events left out")
