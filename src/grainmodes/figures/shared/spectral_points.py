"""Which points with spectra a figure shows, where not every point of the grid has one.

`present` is a table bool (n, phi, k_T) of `spectra.points_with`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared.selection import Options, largest_or, positive, weak

MODES = ("psi_rotational", "bin_psi_rotational")
"""What a spectrum has whose modes were more than counted."""

ANY = ("eigenvalue", "bin_count")
"""What every spectrum has."""


class Place(NamedTuple):
    """The N and φ of a figure, and the k_T that have spectra there, ascending."""

    n: int
    phi: float
    kt: np.ndarray


def place(options: Options, present: xr.DataArray) -> Place:
    """The largest φ with friction, there the N with most k_T (the largest of several), or what is
    asked for.

    Raises:
        ValueError: there is no spectrum where it is asked for.
    """
    frictional = present & (present["kt"] > 0)
    shown = frictional if frictional.any() else present
    if options.n is not None:
        n = largest_or(options.n, _along("n", shown), "n")
        shown, present = (of.where(of["n"] == n, False) for of in (shown, present))
    phi = largest_or(options.phi, _along("phi", shown), "phi")
    number = shown.sel(phi=phi).sum("kt")
    n = number["n"].to_numpy()[(number == number.max()).to_numpy()].max().item()
    return Place(n, phi, _along("kt", present.sel(n=n, phi=phi)))


def place_of_densities(ensemble, options: Options) -> Place:
    """The `place` of points with modes or band averages, of any spectra where none has them.

    `kt` are those with any spectrum there.

    Raises:
        BlockError: the ensemble holds no spectra.
    """
    counted = points_with(ensemble, *ANY)
    averaged = any(name in ensemble for name in MODES)
    chosen = place(options, points_with(ensemble, *MODES) if averaged else counted)
    return chosen._replace(kt=_along("kt", counted.sel(n=chosen.n, phi=chosen.phi)))


def weakly_frictional(ensemble, options: Options, figure: str) -> tuple[xr.DataArray, float]:
    """Points with any spectrum, bool (n, phi), at the one k_T > 0 of the figure, and this k_T.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: it holds none with friction.
    """
    present = points_with(ensemble, *ANY)
    kappa = weak(options.kt, positive(_along("kt", present), figure))
    return present.sel(kt=kappa), kappa


def line(name: str, asked: float | None, present: xr.DataArray) -> tuple[float, np.ndarray]:
    """One value of a coordinate, and the values of the other at which it has points.

    Args:
        name: "n" or "phi", the coordinate that is held.
        asked: its value; None is that with most points, the largest of several.
        present: bool (n, phi).
    """
    (other,) = set(present.dims) - {name}
    size = present.sum(other)
    richest = present.where(size == size.max(), False)
    held = largest_or(asked, _along(name, richest if asked is None else present), name)
    return held, _along(other, present.sel({name: held}))


def _along(name: str, present: xr.DataArray) -> np.ndarray:
    """Values of a coordinate at which there is a point."""
    others = [dimension for dimension in present.dims if dimension != name]
    return present[name].to_numpy()[present.any(others).to_numpy()]
