"""Which points with spectra a figure shows, where not every point of the grid has one.

`present` is a table bool (n, phi, k_T) of `ensemble.spectra.points_with`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from grainmodes.ensemble.spectra import points_with
from grainmodes.figures.shared.selection import (
    Options,
    choose_curves,
    choose_weak,
    largest_or,
    positive_kts,
)

MODE_VARIABLES = ("psi_rotational", "bin_psi_rotational")
"""One of these is in every spectrum with modes or band averages."""

SPECTRUM_VARIABLES = ("eigenvalue", "bin_count")
"""One of these is in every spectrum."""

Coordinates = tuple[int, float, float]
"""n, phi and k_T of a point."""


class SpectralPoints(NamedTuple):
    """The N and φ of a figure, and the k_T that have spectra there, ascending."""

    n: int
    phi: float
    kt: np.ndarray

    def at(self, kts: list[float]) -> list[Coordinates]:
        """The points of some of these k_T."""
        return [(self.n, self.phi, kt) for kt in kts]


def choose_points(options: Options, present: xr.DataArray) -> SpectralPoints:
    """The requested N and φ; without a request, the largest φ with friction, and there the N with
    the most k_T, the largest of several.

    Raises:
        ValueError: there is no spectrum at the requested n or phi.
    """
    frictional = present & (present["kt"] > 0)
    shown = frictional if frictional.any() else present
    if options.n is not None:
        n = largest_or(options.n, _values_with_points("n", shown), "n")
        shown, present = (table.where(table["n"] == n, False) for table in (shown, present))
    phi = largest_or(options.phi, _values_with_points("phi", shown), "phi")
    number = shown.sel(phi=phi).sum("kt")
    n = number["n"].to_numpy()[(number == number.max()).to_numpy()].max().item()
    return SpectralPoints(n, phi, _values_with_points("kt", present.sel(n=n, phi=phi)))


def choose_density_points(ensemble, options: Options) -> SpectralPoints:
    """`choose_points` among those with modes or band averages; among all where none has them.

    `kt` are all k_T with any spectrum there.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: there is no spectrum at the requested n or phi.
    """
    any_spectrum = points_with(ensemble, *SPECTRUM_VARIABLES)
    with_modes = any(name in ensemble for name in MODE_VARIABLES)
    candidates = points_with(ensemble, *MODE_VARIABLES) if with_modes else any_spectrum
    chosen = choose_points(options, candidates)
    kts = _values_with_points("kt", any_spectrum.sel(n=chosen.n, phi=chosen.phi))
    return chosen._replace(kt=kts)


def weak_points_along(varied: str, ensemble, options: Options, figure: str) -> list[Coordinates]:
    """The points of a figure with a curve per N, or per φ, at one small k_T > 0.

    The other of the two is held: at its requested value, else at the value with the most points,
    the largest of several.

    Args:
        varied: "n" or "phi", the coordinate that has a curve per value.

    Raises:
        BlockError: the ensemble holds no spectra.
        ValueError: it holds none with friction, or none at a requested value.
    """
    present = points_with(ensemble, *SPECTRUM_VARIABLES)
    kts = positive_kts(_values_with_points("kt", present), figure)
    kt = choose_weak(options.one_kt(), kts)
    held = "phi" if varied == "n" else "n"
    fixed, values = _hold(held, getattr(options, held), present.sel(kt=kt))
    requested = getattr(options, varied)
    chosen = choose_curves(None if requested is None else (requested,), values, varied)
    return [(value, fixed, kt) if varied == "n" else (fixed, value, kt) for value in chosen]


def _hold(name: str, requested: float | None, present: xr.DataArray) -> tuple[float, np.ndarray]:
    """The value at which a coordinate is held, and the values of the other with points there.

    Args:
        present: bool (n, phi).
    """
    (other,) = set(present.dims) - {name}
    number = present.sum(other)
    candidates = present.where(number == number.max(), False) if requested is None else present
    held = largest_or(requested, _values_with_points(name, candidates), name)
    return held, _values_with_points(other, present.sel({name: held}))


def _values_with_points(name: str, present: xr.DataArray) -> np.ndarray:
    """Values of a coordinate at which there is a point."""
    others = [dimension for dimension in present.dims if dimension != name]
    return present[name].to_numpy()[present.any(others).to_numpy()]
