"""Averages of an ensemble with their standard errors.

An average runs over all converged samples. A sample that is not jammed has g = 0 and counts with
this value, as in A. The fraction of jammed samples is given with every average, so that the two
effects can be separated.
"""

from __future__ import annotations

import pandas as pd
import xarray as xr

from grainmodes.ensemble.reading import variable
from grainmodes.statistics.averages import average

GRID = ["n", "phi", "kt"]


def averages(ensemble: xr.Dataset, names: list[str]) -> pd.DataFrame:
    """Means over the converged samples of every point.

    Args:
        names: variables with one number per sample, such as "g".

    Returns:
        one row per point: n, phi, kt, fraction_jammed, and for each name the columns `name`,
        `name_standard_error` (NaN for fewer than two samples) and `name_samples`.

    Raises:
        BlockError: the ensemble lacks one of the names.
    """
    converged = (variable(ensemble, "converged") == 1).to_numpy()
    jammed = average(variable(ensemble, "jammed").to_numpy(), converged).mean
    columns = {"fraction_jammed": jammed}
    for name in names:
        result = average(variable(ensemble, name).to_numpy(), converged)
        columns[name] = result.mean
        columns[f"{name}_standard_error"] = result.standard_error
        columns[f"{name}_samples"] = result.samples
    index = pd.MultiIndex.from_product([ensemble[name].to_numpy() for name in GRID], names=GRID)
    flat = {name: column.ravel() for name, column in columns.items()}
    return pd.DataFrame(flat, index=index).reset_index()
