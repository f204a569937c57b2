"""Rows of the figures of displacement fields and eigenvectors: one row per grain."""

from __future__ import annotations

import numpy as np
import pandas as pd

from grainmodes.dataset.files import Block
from grainmodes.figures.shared.columns import POINT, SEED
from grainmodes.figures.shared.sample_files import point_of

GRAINS = {
    **POINT,
    **SEED,
    "box_length": ("d", "side L of the periodic box"),
    "strain": ("1", "shear strain of the box"),
    "grain": ("1", "number of the grain"),
    "x": ("d", "x of its centre"),
    "y": ("d", "y of its centre"),
    "diameter": ("d", "its diameter"),
}
"""Columns that say which grain a row is about."""

COMPONENTS = ("x", "y", "rotation")
"""Names of the components (x, y, ℓ) of a field, ℓ = d θ / 2."""


def field_columns(prefix: str, unit: str, meaning: str) -> dict[str, tuple[str, str]]:
    """The three columns of a field, with unit and meaning."""
    words = ("x", "y", "rotation l = d theta / 2")
    return {
        f"{prefix}_{name}": (unit, f"{meaning}, {word}")
        for name, word in zip(COMPONENTS, words, strict=True)
    }


def field_values(prefix: str, field: np.ndarray) -> dict[str, np.ndarray]:
    """The values of these columns, from a field (N, 3)."""
    return {f"{prefix}_{name}": field[:, k] for k, name in enumerate(COMPONENTS)}


def grain_rows(block: Block) -> pd.DataFrame:
    """A row for every grain of the first sample of a block, with the columns `GRAINS`."""
    sample = {name: array[0] for name, array in block.variables.items()}
    x, y = sample["position"].T
    return pd.DataFrame(
        {
            **point_of(block),
            **{name: sample[name] for name in ("seed", "box_length", "strain")},
            "grain": np.arange(len(x)),
            "x": x,
            "y": y,
            "diameter": sample["diameter"],
        }
    )
