"""Opens an ensemble, and reads its variables and the configuration that it was made with."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from grainmodes.dataset.files import BlockError, check_content
from grainmodes.dataset.library import LOCK
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.spectra import SpectrumChoices

if TYPE_CHECKING:
    import xarray as xr

DIMENSIONS = ("n", "phi", "kt", "seed", "mode")


def open_ensemble(path: str | Path) -> xr.Dataset:
    """Open an ensemble whose content is as its checksum says; arrays are read when they are used.

    Raises:
        BlockError: no such file, not a readable netCDF file, a damaged one, or not an ensemble.
    """
    import xarray as xr  # here, because gathering points takes less time than this import

    path = Path(path)
    check_content(path)
    with LOCK:
        ensemble = xr.open_dataset(path, engine="netcdf4", lock=LOCK)
    missing = [name for name in DIMENSIONS if name not in ensemble.dims]
    if missing:
        ensemble.close()
        raise BlockError(
            f"{path}: expected an ensemble, got a file without the dimension {missing[0]}"
        )
    return ensemble


def variable(ensemble: xr.Dataset, name: str) -> xr.DataArray:
    """A variable of an ensemble, dimensions (n, phi, kt, seed, …).

    Raises:
        BlockError: the ensemble lacks it.
    """
    if name not in ensemble:
        source = ensemble.encoding.get("source", "the ensemble")
        raise BlockError(f"{source}: holds no {name}; its study did not request that observable")
    return ensemble[name].transpose("n", "phi", "kt", "seed", ...)


def configuration(ensemble: xr.Dataset) -> dict:
    """The part of the scene that the numbers of an ensemble depend on."""
    return json.loads(ensemble.attrs["config"])


def contact_law(ensemble: xr.Dataset) -> ContactLaw:
    """The contact law of a study, whose k_T is that of each point; A's where none is configured."""
    return ContactLaw(**configuration(ensemble).get("contact_law", {}))


def normal_law(ensemble: xr.Dataset) -> str:
    """The normal contact law, on which units depend."""
    return contact_law(ensemble).normal


def bin_density(ensemble: xr.Dataset) -> float:
    """The factor on the numbers of linear bins that the study chose for its spectra."""
    protocol = configuration(ensemble).get("protocol", {})
    return protocol.get("spectrum", {}).get("bin_density", SpectrumChoices().bin_density)
