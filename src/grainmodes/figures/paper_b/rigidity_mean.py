"""Mean rigidity over the samples against strain: theory, and simulation but events (B, Fig. 9)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble.curves import even_bins
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.appearance import ROTATIONAL
from grainmodes.figures.shared.rigidity_rows import UNIT
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_points import POINT, at_point
from grainmodes.statistics import averages

BINS = 50
"""Bins over all strains."""

COLUMNS = POINT | {
    "kind": ("-", "theory or simulation"),
    "strain": ("1", "middle of a bin of strain"),
    "rigidity": (UNIT, "mean over the samples of g, or of the slope of the stress but in events"),
    "standard_error": (UNIT, "standard error of the mean"),
    "samples": ("1", "number of samples"),
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """Both mean rigidities in bins of strain, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the n, phi or kt asked for.
    """
    point, found = at_point(ensemble, options)
    of = [curve for curve in found.values() if len(curve.step)]
    if not of:
        return pd.DataFrame(columns=list(COLUMNS))
    edges = even_bins(of, min(BINS, max(len(curve.step) for curve in of)))
    kinds = {
        "theory": [curve.mean_slopes(curve.predicted_change, edges) for curve in of],
        "simulation": [curve.mean_slopes(curve.stress_change, edges) for curve in of],
    }
    parts = [_rows(kind, np.array(slopes), edges) for kind, slopes in kinds.items()]
    rows = pd.concat(parts, ignore_index=True).assign(**point)[list(COLUMNS)]
    return rows[rows["samples"] > 0].reset_index(drop=True)


def _rows(kind: str, slopes: np.ndarray, edges: np.ndarray) -> pd.DataFrame:
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


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Line: theory; symbols with bars: simulation."""
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
    axes.set(xlabel=r"$\gamma$", ylabel=appearance.modulus_label("$G$", table))
    axes.legend()
    appearance.write_caption(figure, table, ("n", "phi", "kt"), "steps with events left out")
