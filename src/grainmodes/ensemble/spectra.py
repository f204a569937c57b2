"""The spectrum of one point of an ensemble: mode by mode, or counted in bins.

An ensemble holds every mode of a sample (`eigenvalue`, …) or, for large systems, counts and
averages in bins that all samples of a point share (`bin_edge`, `bin_count`, …). Both have the
method `in_bins`, after which a figure treats them alike.

A sample that is not jammed has no modes and stays as a row without any; a failed one is left out.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from grainmodes.dataset.files import BlockError
from grainmodes.ensemble.lost import points_of_stages
from grainmodes.ensemble.reading import variable
from grainmodes.statistics import averages, binning
from grainmodes.statistics.binning import BinnedModes, BinSums

STAGES_OF_ENDINGS = {"_rattlers": "spectrum_rattlers", "_hessian": "spectrum_hessian"}
"""Ending of the name of a variable → its stage; without any it is `spectrum`."""


class ResolvedModes(NamedTuple):
    """The modes of the S converged samples of one point, each known by itself.

    `eigenvalue` (S, M) in k_N d^(1/2), `psi_rotational` and `participation_ratio` (S, M) without a
    unit; NaN where a sample has no such mode, psi^R and p also where there are no eigenvectors.
    """

    eigenvalue: np.ndarray
    psi_rotational: np.ndarray
    participation_ratio: np.ndarray

    @property
    def frequency(self) -> np.ndarray:
        """(S, M) 1/t_0, NaN where there is no vibration."""
        return averages.frequencies(self.eigenvalue).frequency

    def in_bins(self, edges: np.ndarray) -> BinnedModes:
        """These modes in the bins of `edges`."""
        modes = np.isfinite(self.eigenvalue).sum(axis=1)
        return binning.bin_modes(self.frequency, modes, *self[1:], edges)


def shared_edges(
    spectra: list[ResolvedModes | BinnedModes], kappa: float, bin_density: float
) -> np.ndarray:
    """Edges (B + 1,), 1/t_0, for all spectra: A's bins over their whole range.

    If a spectrum is binned, its edges, and beyond them A's bins as far as resolved modes reach; a
    single edge if none has a vibration.
    """
    counted = next((m.edges for m in spectra if isinstance(m, BinnedModes)), np.zeros(0))
    resolved = [modes.frequency.ravel() for modes in spectra if isinstance(modes, ResolvedModes)]
    frequency = np.concatenate([*resolved, np.zeros(0)])
    if not np.isfinite(frequency).any():
        return counted if len(counted) else np.zeros(1)
    edges = binning.bin_edges(kappa, np.nanmin(frequency), np.nanmax(frequency), bin_density)
    if len(counted) < 2:
        return edges
    return np.concatenate([edges[edges < counted[0]], counted, edges[edges > counted[-1]]])


def points_with(ensemble: xr.Dataset, *names: str) -> xr.DataArray:
    """The points at which a sample has a value of one of the variables: bool (n, phi, kt).

    So are the points at which every sample was lost, so that a figure that wants them says so and
    shows no others instead. If no sample has any, all points with a spectrum.

    Raises:
        BlockError: the ensemble holds none of the names.
    """
    held = [name for name in names if name in ensemble] or [names[0]]
    found = sum(_measured(ensemble, name) for name in held) > 0
    found |= _all_lost(ensemble, STAGES_OF_ENDINGS.get(f"_{held[0].rsplit('_')[-1]}", "spectrum"))
    return found if found.any() else _measured(ensemble, "mode_count")


def spectrum(
    ensemble: xr.Dataset, n: int, phi: float, kt: float, ending: str = ""
) -> ResolvedModes | BinnedModes:
    """The spectrum of one point: its modes where the ensemble has them, else its bins.

    Args:
        ending: of the names of the variables, such as "_rattlers".

    Raises:
        BlockError: the ensemble holds no such spectra.
    """
    eigenvalue = f"eigenvalue{ending}"
    point = _converged(ensemble, n, phi, kt)
    if _lacks(point, eigenvalue) and not _lacks(point, f"bin_count{ending}"):
        return binned_spectrum(ensemble, n, phi, kt, ending)
    variable(ensemble, eigenvalue)
    point = point.sel(seed=point[f"mode_count{ending}"].notnull())
    values = _of_jammed(point, eigenvalue)
    measured = (_of_jammed(point, f"{name}{ending}", values) for name in ResolvedModes._fields[1:])
    return ResolvedModes(values, *measured)


def binned_spectrum(
    ensemble: xr.Dataset, n: int, phi: float, kt: float, ending: str = ""
) -> BinnedModes:
    """The spectrum of one point in bins.

    Args:
        ending: of the names of the variables, such as "_hessian".

    Raises:
        BlockError: the ensemble holds no such bins, or its samples have different ones.
    """
    variable(ensemble, f"bin_count{ending}")
    point = _converged(ensemble, n, phi, kt)
    point = point.sel(seed=point[f"bin_count{ending}"].notnull().any("bin"))
    edges = _shared_edges(point)
    point = point.isel(bin=slice(len(edges) - 1))
    count = np.nan_to_num(_of_jammed(point, f"bin_count{ending}"))
    modes = np.nan_to_num(_of_jammed(point, "mode_count"))
    sums = (_sums(point, f"bin_{name}{ending}", count) for name in ResolvedModes._fields[1:])
    return BinnedModes(edges, count, modes - count.sum(axis=1), *sums)


def _measured(ensemble: xr.Dataset, name: str) -> xr.DataArray:
    values = variable(ensemble, name)
    return values.notnull().any(values.dims[3:])


def _all_lost(ensemble: xr.Dataset, stage: str) -> xr.DataArray:
    """The points at which a stage was requested and no sample is converged: bool (n, phi, kt)."""
    lost = (variable(ensemble, "converged") == 1).sum("seed") > 0
    lost[...] = False
    for n, phi, kt in points_of_stages(ensemble).get(stage, ()):
        point = {"n": n, "phi": phi, "kt": kt}
        lost.loc[point] = not (ensemble["converged"].sel(point) == 1).any()
    return lost


def _converged(ensemble: xr.Dataset, n: int, phi: float, kt: float) -> xr.Dataset:
    point = ensemble.sel(n=n, phi=phi, kt=kt)
    return point.sel(seed=point["converged"] == 1)


def _lacks(point: xr.Dataset, name: str) -> bool:
    return name not in point or not point[name].notnull().any()


def _shared_edges(point: xr.Dataset) -> np.ndarray:
    """The edges (B + 1,) that all samples have; a sample that is not jammed may have none."""
    rows = point["bin_edge"].to_numpy()
    rows = rows[np.isfinite(rows).any(axis=1)]
    if not len(rows):
        return np.zeros(1)
    if not np.array_equal(rows, np.broadcast_to(rows[0], rows.shape), equal_nan=True):
        where = ", ".join(f"{name} = {point[name].item()}" for name in ("n", "phi", "kt"))
        raise BlockError(f"{where}: expected the same bins in all samples, got different bins")
    return rows[0][np.isfinite(rows[0])]


def _of_jammed(point: xr.Dataset, name: str, like: np.ndarray | None = None) -> np.ndarray:
    """A variable by sample, NaN where the sample is not jammed.

    With an array `like`, NaN of its shape where the ensemble lacks the variable.
    """
    if name not in point and like is not None:
        return np.full_like(like, np.nan)
    return point[name].where(point["jammed"] == 1).to_numpy()


def _sums(point: xr.Dataset, name: str, count: np.ndarray) -> BinSums:
    """Sums over the modes of each bin, from the mean in the bin and its error."""
    mean, error = (_of_jammed(point, variable, count) for variable in (name, f"{name}_error"))
    filled = count > 0
    return BinSums(np.where(filled, count * mean, 0.0), np.where(filled, count * error, 0.0))
