"""Rows of the figures of the rigidity: one per point of the grid and kind of G."""

from __future__ import annotations

import numpy as np
import pandas as pd

from grainmodes.ensemble import normal_law
from grainmodes.ensemble.averages import averages
from grainmodes.figures.shared.selection import largest_or

UNIT = "k_N d^(1/2); harmonic: k_N"

COLUMNS = {
    "law": ("-", "normal contact law"),
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("k_N", "tangential stiffness k_T"),
    "kind": ("-", "which G"),
    "rigidity": (UNIT, "mean over the converged samples; unjammed ones count as 0"),
    "standard_error": (UNIT, "standard error of the mean"),
    "samples": ("1", "number of converged samples"),
    "fraction_jammed": ("1", "fraction of these samples that is jammed"),
}


def rows(ensemble, kinds: dict[str, str], asked: int | None) -> pd.DataFrame:
    """Means of several variables of an ensemble below each other, at one N.

    Args:
        kinds: word for the column `kind` → variable of the ensemble; what it lacks is left out.
        asked: number of grains; None is the one at most points with a G, the largest of several.

    Returns:
        columns `COLUMNS`; points without a converged sample are left out.
    """
    present = {kind: name for kind, name in kinds.items() if name in ensemble}
    means = averages(ensemble, list(present.values()) or list(kinds.values()))
    parts = [_one(means, kind, name) for kind, name in present.items()]
    table = pd.concat(parts, ignore_index=True).assign(law=normal_law(ensemble))[list(COLUMNS)]
    table = table[table["samples"] > 0]
    having = table["n"] if len(table) else ensemble["n"]
    sizes, points = np.unique(having.to_numpy(), return_counts=True)
    n = largest_or(asked, sizes if asked else sizes[points == points.max()], "n")
    return table[table["n"] == n].reset_index(drop=True)


def _one(means: pd.DataFrame, kind: str, name: str) -> pd.DataFrame:
    renamed = {
        name: "rigidity",
        f"{name}_standard_error": "standard_error",
        f"{name}_samples": "samples",
    }
    return means.assign(kind=kind).rename(columns=renamed)
