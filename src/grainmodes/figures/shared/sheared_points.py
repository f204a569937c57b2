"""The sheared point of an ensemble that a figure shows, and one sample of it."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.ensemble import normal_law
from grainmodes.ensemble.curves import Curve, curves, points_with_curves
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.selection import Options, first_or, largest_or

POINT = {
    "law": ("-", "normal contact law"),
    "n": ("1", "number of grains N"),
    "phi": ("1", "area fraction"),
    "kt": ("k_N", "tangential stiffness k_T"),
}
SAMPLE = POINT | {"seed": ("1", "the sample")}
SMALL = 0.002
"""The strains of B, Figs. 7 and 8."""

EVENTS = "#b2182b"
"""Colour of what belongs to plastic events."""


def at_point(ensemble, options: Options) -> tuple[dict, dict[int, Curve]]:
    """The values of `POINT` shown, and the curves there by seed; none where no sample has any.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the n, phi or kt asked for, or several kt are.
    """
    found = points_with_curves(ensemble)
    if not found:
        return {}, {}
    point = shown(found, options)
    return {"law": normal_law(ensemble)} | point, curves(ensemble, **point)


def shown(points: list[tuple[int, float, float]], options: Options) -> dict[str, float]:
    """n, phi and kt of the one point that is asked for, else of the largest.

    Raises:
        ValueError: none of the points has the n, phi or kt asked for, or several kt are.
    """
    if options.kt is not None and len(options.kt) > 1:
        raise ValueError(f"kt: expected one value for this figure, got {len(options.kt)}")
    asked = {"n": options.n, "phi": options.phi, "kt": options.kt and options.kt[0]}
    point = {}
    for axis, name in enumerate(asked):
        point[name] = largest_or(asked[name], np.unique([p[axis] for p in points]), name)
        points = [p for p in points if p[axis] == point[name]]
    return point


def sample(ensemble, options: Options, columns: dict) -> tuple[Curve | None, pd.DataFrame]:
    """The curve of one sample, and a table of the columns with only its place filled in.

    Raises:
        BlockError, ValueError: as `at_point`; no curve has the seed asked for.
    """
    point, found = at_point(ensemble, options)
    if not found:
        return None, pd.DataFrame(columns=list(columns))
    seed = first_or(options.seed, np.array(sorted(found)), "seed")
    curve = found[seed]
    table = pd.DataFrame(index=range(len(curve.strain)), columns=list(columns))
    return curve, table.assign(**point, seed=seed)


def name_sample(figure: Figure, table: pd.DataFrame, note: str) -> None:
    """Constants of the sample, and a note, on top."""
    row = table.iloc[0]
    parts = [appearance.CONSTANTS[name](row[name]) for name in ("n", "phi", "kt")]
    figure.suptitle(", ".join([*parts, f"sample {row['seed']}"]) + f"\n{note}")
