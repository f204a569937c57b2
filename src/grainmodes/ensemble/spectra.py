"""The spectrum of one point of an ensemble: mode by mode, or counted in bins.

A study holds every mode of a sample (`eigenvalue`, …) or, beyond dense sizes, counts and averages
in bins that all samples of a point share (`bin_edge`, `bin_count`, …). Both have `in_bins`, and
from there on a figure does not know which it was.

A sample that is not jammed has no modes and stays a row without any; one that failed is left out.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from grainmodes.dataset.files import BlockError
from grainmodes.ensemble.reading import variable
from grainmodes.statistics import averages, binning
from grainmodes.statistics.binning import Binned, Sums


class Spectrum(NamedTuple):
    """The modes of the S converged samples of one point, (S, M), NaN where there is no mode.

    `eigenvalue` in k_N d^(1/2); psi^R and p are NaN also where no eigenvectors were computed.
    """

    eigenvalue: np.ndarray
    psi_rotational: np.ndarray
    participation_ratio: np.ndarray

    @property
    def frequency(self) -> np.ndarray:
        """(S, M) 1/t_0, NaN where there is no vibration."""
        return averages.frequencies(self.eigenvalue).frequency

    def in_bins(self, edges: np.ndarray) -> Binned:
        """These modes in the bins of `edges`."""
        modes = np.isfinite(self.eigenvalue).sum(axis=1)
        return binning.binned(self.frequency, modes, *self[1:], edges)


def shared_edges(spectra: list[Spectrum | Binned], kappa: float, bin_density: float) -> np.ndarray:
    """A's bins over the range of all spectra, or the bins in which one of them was counted.

    One edge only where there is no vibration.
    """
    for of in spectra:
        if isinstance(of, Binned):
            return of.edges
    frequency = np.concatenate([of.frequency.ravel() for of in spectra])
    if not np.isfinite(frequency).any():
        return np.zeros(1)
    return binning.bin_edges(kappa, np.nanmin(frequency), np.nanmax(frequency), bin_density)


def points_with(ensemble: xr.Dataset, *names: str) -> xr.DataArray:
    """Points at which a sample has a number under one of the names: bool (n, phi, kt).

    Where a study asked for one of them but no sample has any mode, every point with a spectrum.

    Raises:
        BlockError: the ensemble holds none of the names.
    """
    held = [name for name in names if name in ensemble] or [names[0]]
    found = sum(_measured(ensemble, name) for name in held) > 0
    return found if found.any() else _measured(ensemble, "mode_count")


def spectrum(
    ensemble: xr.Dataset, n: int, phi: float, kt: float, variant: str = ""
) -> Spectrum | Binned:
    """The spectrum of one point: its modes where the study has them, else its bins.

    Args:
        variant: ending of the names, as "_rattlers".

    Raises:
        BlockError: the ensemble holds no such spectra.
    """
    eigenvalue = f"eigenvalue{variant}"
    point = _converged(ensemble, n, phi, kt)
    if _lacks(point, eigenvalue) and not _lacks(point, f"bin_count{variant}"):
        return counted(ensemble, n, phi, kt, variant)
    variable(ensemble, eigenvalue)
    point = point.sel(seed=point[f"mode_count{variant}"].notnull())
    values = _of_jammed(point, eigenvalue)
    measured = (_of_jammed(point, f"{name}{variant}", values) for name in Spectrum._fields[1:])
    return Spectrum(values, *measured)


def counted(ensemble: xr.Dataset, n: int, phi: float, kt: float, variant: str = "") -> Binned:
    """The bins of one point.

    Args:
        variant: ending of the names, as "_hessian".

    Raises:
        BlockError: the ensemble holds no such bins, or its samples have different ones.
    """
    variable(ensemble, f"bin_count{variant}")
    point = _converged(ensemble, n, phi, kt)
    point = point.sel(seed=point[f"bin_count{variant}"].notnull().any("bin"))
    edges = _shared_edges(point)
    point = point.isel(bin=slice(len(edges) - 1))
    count = np.nan_to_num(_of_jammed(point, f"bin_count{variant}"))
    modes = np.nan_to_num(_of_jammed(point, "mode_count"))
    bands = (_sums(point, f"bin_{name}{variant}", count) for name in Spectrum._fields[1:])
    return Binned(edges, count, modes - count.sum(axis=1), *bands)


def _measured(ensemble: xr.Dataset, name: str) -> xr.DataArray:
    values = variable(ensemble, name)
    return values.notnull().any(values.dims[3:])


def _converged(ensemble: xr.Dataset, n: int, phi: float, kt: float) -> xr.Dataset:
    point = ensemble.sel(n=n, phi=phi, kt=kt)
    return point.sel(seed=point["converged"] == 1)


def _lacks(point: xr.Dataset, name: str) -> bool:
    return name not in point or not point[name].notnull().any()


def _shared_edges(point: xr.Dataset) -> np.ndarray:
    """The edges of all samples; a sample that is not jammed need not have any."""
    rows = point["bin_edge"].to_numpy()
    rows = rows[np.isfinite(rows).any(axis=1)]
    if not len(rows):
        return np.zeros(1)
    if not np.array_equal(rows, np.broadcast_to(rows[0], rows.shape), equal_nan=True):
        where = ", ".join(f"{name} = {point[name].item()}" for name in ("n", "phi", "kt"))
        raise BlockError(f"{where}: the samples are counted in different bins")
    return rows[0][np.isfinite(rows[0])]


def _of_jammed(point: xr.Dataset, name: str, like: np.ndarray | None = None) -> np.ndarray:
    """A variable by sample, NaN where the sample is not jammed, or where the study has none."""
    if name not in point and like is not None:
        return np.full_like(like, np.nan)
    return point[name].where(point["jammed"] == 1).to_numpy()


def _sums(point: xr.Dataset, name: str, count: np.ndarray) -> Sums:
    """Sums over the modes of each bin, from their mean and its error."""
    mean, error = (_of_jammed(point, of, count) for of in (name, f"{name}_error"))
    filled = count > 0
    return Sums(np.where(filled, count * mean, 0.0), np.where(filled, count * error, 0.0))
