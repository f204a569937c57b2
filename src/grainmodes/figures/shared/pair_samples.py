"""The sample with exceptional points that a figure of complex pairs shows, and its eigenvalues."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from grainmodes.ensemble.exceptional import PairSample, pair_samples
from grainmodes.figures.shared import columns
from grainmodes.figures.shared.appearance import BLUE, RED
from grainmodes.figures.shared.selection import Options, largest_or, smallest_or

SAMPLE = columns.POINT | columns.LAW | columns.SEED

EIGENVALUE_UNIT = "1/t_0^2"

EIGENVALUES = {
    "real_1": (EIGENVALUE_UNIT, "real part of the first eigenvalue of J / M"),
    "real_2": (EIGENVALUE_UNIT, "real part of the second one"),
    "imaginary": (EIGENVALUE_UNIT, "imaginary part of the first one; the second has its negative"),
}

FIRST, SECOND = BLUE, RED
"""Colours of the two modes."""


def choose_sample(found: list[PairSample], options: Options) -> PairSample | None:
    """The sample at the requested n, phi, kt and seed; else at the largest ones and the first seed.

    Raises:
        ValueError: there is none at a requested value.
    """
    requested = {"n": options.n, "phi": options.phi, "kt": options.kt and options.kt[0]}
    for name, value in requested.items():
        if found:
            chosen = largest_or(value, np.unique([s.coordinates[name] for s in found]), name)
            found = [s for s in found if s.coordinates[name] == chosen]
    if not found:
        return None
    seed = smallest_or(options.seed, np.unique([s.coordinates["seed"] for s in found]), "seed")
    return next(s for s in found if s.coordinates["seed"] == seed)


def samples_with_paths(ensemble) -> list[PairSample]:
    """The samples in which two modes were followed along the shear.

    Raises:
        BlockError: the study did not request complex pairs.
    """
    return [sample for sample in pair_samples(ensemble) if len(sample.path)]


def longest_pair(sample: PairSample) -> pd.DataFrame:
    """The path of one exceptional point, as C's Fig. 3 shows it.

    Of the pairs that are born and die where two eigenvalues meet, and whose modes are real at both
    ends of the path, the one that is a complex pair in the most states between. If there is none,
    of the pairs that are real at both ends; else of all.
    """
    whole = sample.exceptional_points["whole"]
    paths = [(bool(whole.get(point, False)), path) for point, path in sample.path.groupby("point")]

    def rank(entry: tuple[bool, pd.DataFrame]) -> tuple[bool, bool, int]:
        coalesces, path = entry
        both_ends = _is_real_at_both_ends(path)
        return coalesces and both_ends, both_ends, int(is_pair(path).sum())

    return max(paths, key=rank)[1]


def is_pair(path: pd.DataFrame) -> pd.Series:
    """In which states of a path the two modes are a complex pair."""
    return path["imaginary"] > 0.0


def _is_real_at_both_ends(path: pd.DataFrame) -> bool:
    return not is_pair(path.iloc[[0, -1]]).any()


def draw_eigenvalues(real: Axes, imaginary: Axes, path: pd.DataFrame) -> None:
    """Draw Re λ and Im λ of the two modes against γ, with dashed lines at the ends of the pair."""
    for column, sign, colour in (("real_1", 1.0, FIRST), ("real_2", -1.0, SECOND)):
        style = {"color": colour, "markersize": 2.2, "lw": 0.8}
        real.plot(path["strain"], path[column], "o-", **style)
        imaginary.plot(path["strain"], sign * path["imaginary"], "o-", **style)
    real.set(ylabel=r"$\mathrm{Re}\,\lambda\,t_0^2$")
    imaginary.set(ylabel=r"$\mathrm{Im}\,\lambda\,t_0^2$")
    for axes in (real, imaginary):
        mark_ends(axes, path)


def mark_ends(axes: Axes, path: pd.DataFrame) -> None:
    """Draw a dashed line between each two states of which one is real and the other a pair."""
    pair = is_pair(path).to_numpy()
    strain = path["strain"].to_numpy()
    for state in np.flatnonzero(pair[1:] != pair[:-1]):
        axes.axvline(strain[state : state + 2].mean(), color="0.6", ls="--", lw=0.7, zorder=0)
