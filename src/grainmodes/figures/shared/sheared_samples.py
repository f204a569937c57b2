"""The sheared point of an ensemble that a figure shows, and one sample of it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pandas as pd

from grainmodes.ensemble import contact_law
from grainmodes.ensemble.curves import Curve, curves, points_with_curves
from grainmodes.figures.shared import columns
from grainmodes.figures.shared.selection import Options, largest_or, smallest_or

POINT = columns.LAW | columns.POINT
SAMPLE = POINT | columns.SEED

SMALL_STRAIN = 0.002
"""Range of the strains of B, Figs. 7 and 8."""


def curves_at_point(ensemble, options: Options) -> tuple[dict, dict[int, Curve]]:
    """The values of `POINT` shown, and the curves there by seed; both empty without any curve.

    Raises:
        BlockError: the ensemble holds no curves.
        ValueError: no curve lies at the requested n, phi or kt, or several kt are requested.
    """
    points = points_with_curves(ensemble)
    if not points:
        return {}, {}
    point = choose_point(points, options)
    return columns.law_values(contact_law(ensemble)) | point, curves(ensemble, **point)


def choose_point(points: list[tuple[int, float, float]], options: Options) -> dict[str, float]:
    """n, phi and kt of the one requested point; the largest ones where none are requested.

    Raises:
        ValueError: none of the points has the requested n, phi or kt, or several kt are requested.
    """
    requested = {"n": options.n, "phi": options.phi, "kt": options.one_kt()}
    chosen = {}
    for axis, (name, value) in enumerate(requested.items()):
        chosen[name] = largest_or(value, np.unique([point[axis] for point in points]), name)
        points = [point for point in points if point[axis] == chosen[name]]
    return chosen


def one_curve(
    ensemble,
    options: Options,
    column_names: dict,
    prefer: Callable[[Curve], float] = lambda curve: 0.0,
) -> tuple[Curve | None, pd.DataFrame]:
    """The curve of one sample, and a row per state of it where only the columns `SAMPLE` are
    filled in.

    Args:
        prefer: where no seed is requested, the first sample that has the largest of this is shown.

    Raises:
        BlockError, ValueError: as `curves_at_point`; no curve has the requested seed.
    """
    point, found = curves_at_point(ensemble, options)
    if not found:
        return None, pd.DataFrame(columns=list(column_names))
    seeds = np.array(sorted(found))
    first = seeds[np.argmax([prefer(found[seed]) for seed in seeds])]
    seed = smallest_or(options.seed, seeds, "seed") if options.seed is not None else int(first)
    curve = found[seed]
    rows = pd.DataFrame(index=range(len(curve.strain)), columns=list(column_names))
    return curve, rows.assign(**point, seed=seed)


def earliness(curve: Curve) -> float:
    """Minus the strain of the first plastic event, as near to B's Figs. 7 and 8 as there is."""
    return -float(curve.strain[:-1][curve.event].min(initial=np.inf))


def at_small_strain(strain: pd.Series, limit: float = SMALL_STRAIN) -> pd.Series:
    """Whether each strain is at most the limit, but for rounding."""
    return strain <= limit * (1 + 1e-9)
