"""Averages of an ensemble with their uncertainties, and the spectra of one point.

An average runs over all converged samples. An unjammed sample has g = 0 and counts as such, as in
A; the fraction jammed stands beside every average, so that the two effects can be told apart.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from grainmodes import statistics
from grainmodes.dataset import BlockError

GRID = ["n", "phi", "kt"]


class Spectrum(NamedTuple):
    """The modes of the S converged samples of one point."""

    eigenvalue: np.ndarray
    psi_rotational: np.ndarray


def averages(ensemble: xr.Dataset, names: list[str]) -> pd.DataFrame:
    """Means over the converged samples of every point.

    Args:
        names: variables of one number per sample, as "g".

    Returns:
        one row per point: n, phi, kt, fraction_jammed, and for each name the columns `name`,
        `name_standard_error` (NaN for fewer than two samples) and `name_samples`.

    Raises:
        BlockError: the ensemble lacks one of the names.
    """
    converged = (_variable(ensemble, "converged") == 1).to_numpy()
    jammed = statistics.average(_variable(ensemble, "jammed").to_numpy(), converged).mean
    columns = {"fraction_jammed": jammed}
    for name in names:
        result = statistics.average(_variable(ensemble, name).to_numpy(), converged)
        columns[name] = result.mean
        columns[f"{name}_standard_error"] = result.standard_error
        columns[f"{name}_samples"] = result.samples
    index = pd.MultiIndex.from_product([ensemble[name].to_numpy() for name in GRID], names=GRID)
    flat = {name: column.ravel() for name, column in columns.items()}
    return pd.DataFrame(flat, index=index).reset_index()


def spectrum(ensemble: xr.Dataset, n: int, phi: float, kt: float) -> Spectrum:
    """Eigenvalues and rotational fractions of the converged samples of one point.

    Returns:
        eigenvalue (S, M), k_N d^(1/2), and psi_rotational (S, M), 1; NaN where there is no mode,
        psi_rotational NaN also where the study computed no eigenvectors. A sample that is not
        jammed is a row of NaN.

    Raises:
        BlockError: the ensemble holds no spectra.
    """
    _variable(ensemble, "eigenvalue")
    point = ensemble.sel(n=n, phi=phi, kt=kt)
    used = ((point["converged"] == 1) & point["mode_count"].notnull()).to_numpy()
    eigenvalue = point["eigenvalue"].where(point["jammed"] == 1).to_numpy()[used]
    if "psi_rotational" not in point:
        return Spectrum(eigenvalue, np.full_like(eigenvalue, np.nan))
    return Spectrum(eigenvalue, point["psi_rotational"].to_numpy()[used])


def area_fractions_with_spectra(ensemble: xr.Dataset, n: int) -> np.ndarray:
    """Area fractions at which the study computed spectra of n grains, ascending.

    Raises:
        BlockError: the ensemble holds no spectra.
    """
    _variable(ensemble, "eigenvalue")
    computed = ensemble["mode_count"].sel(n=n).notnull().any(["kt", "seed"])
    return ensemble["phi"].to_numpy()[computed.to_numpy()]


def _variable(ensemble: xr.Dataset, name: str) -> xr.DataArray:
    if name not in ensemble:
        source = ensemble.encoding.get("source", "the ensemble")
        raise BlockError(f"{source}: holds no {name}; its study did not ask for that observable")
    return ensemble[name].transpose(*GRID, "seed", ...)
