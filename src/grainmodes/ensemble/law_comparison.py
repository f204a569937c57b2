"""Packings sheared under several tangential laws, sample by sample: C, Sec. VIII."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from grainmodes.ensemble.reading import variable
from grainmodes.parameters.law import TANGENTIAL_LAWS

if TYPE_CHECKING:
    import xarray as xr

NUMBERS = ("pairs_slipping", "pairs_sticking", "rate", "growth")


def points_with_comparison(ensemble: xr.Dataset) -> list[tuple[int, float, float]]:
    """The points (n, phi, kt) with a converged sample that is jammed and was sheared, ascending.

    Raises:
        BlockError: the ensemble holds no comparison of laws.
    """
    states = variable(ensemble, "comparison_count").where(ensemble["converged"] == 1).max("seed")
    axes = [states[name].to_numpy().tolist() for name in ("n", "phi", "kt")]
    places = zip(*np.nonzero(states.to_numpy() > 0), strict=True)
    return [tuple(axis[k] for axis, k in zip(axes, place, strict=True)) for place in places]


def comparison_at(
    ensemble: xr.Dataset, n: int, phi: float, kt: float
) -> tuple[np.ndarray, dict[str, dict[str, np.ndarray]]]:
    """The strains (M,) of a point, and law → name in `NUMBERS` → values (S, M), NaN if unknown.

    The S samples are those that are converged.

    Raises:
        BlockError: the ensemble holds no comparison of laws.
    """
    point = variable(ensemble, "comparison_strain").sel(n=n, phi=phi, kt=kt).to_numpy()
    converged = variable(ensemble, "converged").sel(n=n, phi=phi, kt=kt).to_numpy() == 1
    used = converged & np.isfinite(point).any(axis=1)
    strain = np.nanmax(point[used], axis=0)
    found = {}
    for law in TANGENTIAL_LAWS:
        rows = (variable(ensemble, f"comparison_{number}_{law}") for number in NUMBERS)
        values = (row.sel(n=n, phi=phi, kt=kt).to_numpy()[used] for row in rows)
        found[law] = dict(zip(NUMBERS, values, strict=True))
    return strain, found
