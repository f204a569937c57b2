"""Exceptional points of an ensemble, with the states around them and the modes along the walk: C.

| symbol             | name         | where                                           |
| ------------------ | ------------ | ----------------------------------------------- |
| γ − γ_c            | distance     | states around a point, ascending                |
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
NEAR = ("point", "distance", "sum", "discriminant", "product", "condition")
PATH = ("point", "strain", "real_1", "real_2", "imaginary", "product")
PRODUCT = ("strain", "mode", "other", "value")


@dataclass(frozen=True)
class Sample:
    """Coalescences of one sample, states around them, paths: data frames with the number `point`.

    `points` has track, birth, strain, and the exponents where the modes are real and are a pair.
    """

    place: dict[str, float]
    points: pd.DataFrame
    near: pd.DataFrame
    path: pd.DataFrame
    products: pd.DataFrame


def samples(ensemble: xr.Dataset) -> list[Sample]:
    """Every converged and jammed sample with a located coalescence, in the order of the grid.

    Raises:
        BlockError: its study did not ask for complex pairs.
    """
    variable(ensemble, "pair_state_count")
    if "exceptional_point_kind" not in ensemble:
        return []
    used = (ensemble["converged"] == 1) & (ensemble["jammed"] == 1)
    kinds = ensemble["exceptional_point_kind"].where(used)
    found = (kinds == COALESCENCE).any("exceptional_point").transpose(*AXES).to_numpy()
    grid = [ensemble[axis].to_numpy().tolist() for axis in AXES]
    places = [[of[k] for of, k in zip(grid, at, strict=True)] for at in np.argwhere(found).tolist()]
    return [_sample(ensemble, dict(zip(AXES, place, strict=True))) for place in places]


def _sample(ensemble: xr.Dataset, place: dict[str, float]) -> Sample:
    row = ensemble.sel(place)
    names = ("track", "birth", "kind", "strain", "exponent_real", "exponent_pair")
    points = _frame(row, "exceptional_point", names)
    points = points[points["kind"] == COALESCENCE]
    products = _frame(row, "product", PRODUCT).rename(columns={"value": "product"})
    near, path = _frame(row, "neighbour", NEAR), _frame(row, "followed", PATH)
    return Sample(place, points, near, path, products)


def _frame(row: xr.Dataset, of: str, names: tuple[str, ...]) -> pd.DataFrame:
    """Variables `of_name` as columns, without the rows that only fill up; empty where absent."""
    if f"{of}_strain" not in row and f"{of}_distance" not in row:
        return pd.DataFrame(columns=list(names))
    table = pd.DataFrame({name: row[f"{of}_{name}"].to_numpy() for name in names})
    key = "distance" if "distance" in names else "strain"
    return table[np.isfinite(table[key])]
