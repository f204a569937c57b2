"""Exceptional points of an ensemble, with the states around them and the modes along the shear: C.

| symbol             | name         | where                                           |
| ------------------ | ------------ | ----------------------------------------------- |
| γ − γ_c            | distance     | states around an exceptional point, ascending   |
| D = (λ1 − λ2)²     | discriminant | below 0 for a pair                              |
| |Σ u1_j u2_j|      | product      | scalar product of the two eigenvectors          |
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from grainmodes.ensemble.reading import variable

if TYPE_CHECKING:
    import xarray as xr

COALESCENCE = 1
"""The `exceptional_point_kind` of a point where two eigenvalues meet."""

AXES = ("n", "phi", "kt", "seed")
NEIGHBOUR_COLUMNS = ("point", "distance", "sum", "discriminant", "product", "condition")
PATH_COLUMNS = ("point", "strain", "real_1", "real_2", "imaginary", "product")
PRODUCT_COLUMNS = ("strain", "mode", "other", "value")


@dataclass(frozen=True)
class PairSample:
    """The exceptional points of one sample, the states around them and the paths of the two modes.

    `coordinates` has n, phi, kt and seed. `exceptional_points` has the columns track, birth, kind
    and strain, the exponents on the side where the modes are real and where they are a pair, and
    `whole`: whether its pair is born and dies where two eigenvalues meet.
    In `neighbours` and `path` the column `point` is the row of the exceptional point.
    """

    coordinates: dict[str, float]
    exceptional_points: pd.DataFrame
    neighbours: pd.DataFrame
    path: pd.DataFrame
    products: pd.DataFrame


def pair_samples(ensemble: xr.Dataset) -> list[PairSample]:
    """Every converged and jammed sample with a located exceptional point, in the order of the grid.

    Raises:
        BlockError: the study did not compute complex pairs.
    """
    variable(ensemble, "pair_state_count")
    if "exceptional_point_kind" not in ensemble:
        return []
    used = (ensemble["converged"] == 1) & (ensemble["jammed"] == 1)
    kinds = ensemble["exceptional_point_kind"].where(used)
    found = (kinds == COALESCENCE).any("exceptional_point").transpose(*AXES).to_numpy()
    grid = [ensemble[axis].to_numpy().tolist() for axis in AXES]
    samples = []
    for indices in np.argwhere(found).tolist():
        values = [axis[k] for axis, k in zip(grid, indices, strict=True)]
        samples.append(_sample(ensemble, dict(zip(AXES, values, strict=True))))
    return samples


def _sample(ensemble: xr.Dataset, coordinates: dict[str, float]) -> PairSample:
    row = ensemble.sel(coordinates)
    names = ("track", "birth", "kind", "strain", "exponent_real", "exponent_pair")
    points = _frame(row, "exceptional_point", names)
    points = points[points["kind"] == COALESCENCE]
    tracks = points["track"].to_numpy(int)
    points = points.assign(whole=_is_coalescence(row, "birth")[tracks])
    points["whole"] &= _is_coalescence(row, "death")[tracks]
    products = _frame(row, "product", PRODUCT_COLUMNS).rename(columns={"value": "product"})
    neighbours = _frame(row, "neighbour", NEIGHBOUR_COLUMNS)
    path = _frame(row, "followed", PATH_COLUMNS)
    return PairSample(coordinates, points, neighbours, path, products)


def _is_coalescence(row: xr.Dataset, event: str) -> np.ndarray:
    """Which tracks of a sample are born, or die, where two eigenvalues meet: (tracks,) bool."""
    return np.asarray(row[f"track_{event}_kind"].to_numpy() == COALESCENCE)


def _frame(row: xr.Dataset, prefix: str, names: tuple[str, ...]) -> pd.DataFrame:
    """The variables `prefix_name` as columns, without the padding; empty where they are absent."""
    if f"{prefix}_strain" not in row and f"{prefix}_distance" not in row:
        return pd.DataFrame(columns=list(names))
    table = pd.DataFrame({name: row[f"{prefix}_{name}"].to_numpy() for name in names})
    key = "distance" if "distance" in names else "strain"
    return table[np.isfinite(table[key])]
