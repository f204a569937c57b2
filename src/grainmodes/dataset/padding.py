"""Rows of different lengths in one array: the shorter ones are filled up."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray


def stack_padded(
    rows: Sequence[ArrayLike | None],
    fill: float,
    dtype: DTypeLike | None = None,
    min_shape: tuple[int, ...] | None = None,
) -> NDArray:
    """Rows of different shapes along a new first axis, each at the start of its place.

    Args:
        rows: arrays with the same number of dimensions; a row that is None holds `fill` alone. If
            all are None, each counts as a single number.
        fill: the value of all places that no row covers.
        dtype: of the result; by default that of the first row, or float64 if all are None.
        min_shape: smallest shape of a row in the result.

    Raises:
        ValueError: the rows have different numbers of dimensions.
    """
    arrays = [None if row is None else np.asarray(row, dtype) for row in rows]
    present = [array for array in arrays if array is not None]
    shapes = [array.shape for array in present] + ([] if min_shape is None else [min_shape])
    if len({len(shape) for shape in shapes}) > 1:
        raise ValueError(f"rows to stack: expected one number of dimensions, got shapes {shapes}")
    shape = tuple(max(lengths) for lengths in zip(*shapes, strict=True))
    stacked = np.full((len(arrays), *shape), fill, present[0].dtype if present else dtype)
    for place, array in enumerate(arrays):
        if array is not None:
            covered: tuple[int | slice, ...] = (place, *map(slice, array.shape))
            stacked[covered] = array
    return stacked
