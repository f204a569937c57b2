"""Rows of the figures of the rigidity: one per point of the grid and kind of G."""

from __future__ import annotations

import numpy as np
import pandas as pd

from grainmodes.ensemble import contact_law
from grainmodes.ensemble.averages import averages
from grainmodes.figures.shared.columns import LAW, POINT, RIGIDITY_UNIT, law_values
from grainmodes.figures.shared.selection import Options, choose_curves, largest_or

COLUMNS = {
    **LAW,
    **POINT,
    "kind": ("-", "which G"),
    "rigidity": (RIGIDITY_UNIT, "mean over the converged samples; unjammed ones count as 0"),
    "standard_error": (RIGIDITY_UNIT, "standard error of the mean"),
    "samples": ("1", "number of converged samples"),
    "fraction_jammed": ("1", "fraction of these samples that is jammed"),
}


def rigidity_rows_at_kts(ensemble, kinds: dict[str, str], options: Options) -> pd.DataFrame:
    """`rigidity_rows` at the requested k_T, else at all, or evenly spread ones if too many.

    Raises:
        ValueError: the ensemble lacks a requested n or kt.
    """
    rows = rigidity_rows(ensemble, kinds, options.n)
    return rows[rows["kt"].isin(choose_curves(options.kt, ensemble["kt"].to_numpy(), "kt"))]


def rigidity_rows(ensemble, kinds: dict[str, str], requested_n: int | None) -> pd.DataFrame:
    """Means of several variables of an ensemble below each other, at one N.

    Args:
        kinds: word for the column `kind` → variable; variables that the ensemble lacks are left
            out.
        requested_n: number of grains; None is the one at the most points with a G, the largest of
            several.

    Returns:
        rows with the columns `COLUMNS`; points without a converged sample are left out.
    """
    present = {kind: name for kind, name in kinds.items() if name in ensemble}
    means = averages(ensemble, list(present.values()) or list(kinds.values()))
    parts = [_rows_of_kind(means, kind, name) for kind, name in present.items()]
    law = law_values(contact_law(ensemble))
    rows = pd.concat(parts, ignore_index=True).assign(**law)[list(COLUMNS)]
    rows = rows[rows["samples"] > 0]
    known = rows["n"] if len(rows) else ensemble["n"]
    sizes, points = np.unique(known.to_numpy(), return_counts=True)
    candidates = sizes if requested_n else sizes[points == points.max()]
    n = largest_or(requested_n, candidates, "n")
    return rows[rows["n"] == n].reset_index(drop=True)


def _rows_of_kind(means: pd.DataFrame, kind: str, name: str) -> pd.DataFrame:
    renamed = {
        name: "rigidity",
        f"{name}_standard_error": "standard_error",
        f"{name}_samples": "samples",
    }
    return means.assign(kind=kind).rename(columns=renamed)
