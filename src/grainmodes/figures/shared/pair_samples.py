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

PAPER_N = 500
"""N of C's Figs. 1 and 3."""

EIGENVALUE_UNIT = "1/t_0^2"

EIGENVALUES = {
    "real_1": (EIGENVALUE_UNIT, "real part of the first eigenvalue of J / M"),
    "real_2": (EIGENVALUE_UNIT, "real part of the second one"),
    "imaginary": (EIGENVALUE_UNIT, "imaginary part of the first one; the second has its negative"),
}

FIRST, SECOND = BLUE, RED
"""Colours of the two modes."""


def choose_sample(found: list[PairSample], options: Options) -> PairSample | None:
    """The sample at the requested n, phi, kt and seed.

    Without a request it is one of the N nearest to C's and of the largest φ and k_T, and of these
    the first one with a pair as C's Fig. 3 shows it (`longest_pair`).

    Raises:
        ValueError: there is none at a requested value, or several kt are requested.
    """
    requested = {"phi": options.phi, "kt": options.one_kt()}
    found = _at_size(found, options.n)
    for name, value in requested.items():
        if found:
            chosen = largest_or(value, np.unique([s.coordinates[name] for s in found]), name)
            found = [s for s in found if s.coordinates[name] == chosen]
    if options.seed is not None and found:
        seed = smallest_or(options.seed, np.unique([s.coordinates["seed"] for s in found]), "seed")
        found = [s for s in found if s.coordinates["seed"] == seed]
    found = sorted(found, key=lambda sample: sample.coordinates["seed"])
    return max(found, key=lambda sample: _best(sample)[0][:2], default=None)


def _at_size(found: list[PairSample], n: int | None) -> list[PairSample]:
    """The samples of the requested N, else of the N nearest to C's by its logarithm."""
    sizes = np.unique([sample.coordinates["n"] for sample in found])
    if not len(sizes):
        return []
    nearest = sizes[np.argmin(np.abs(np.log(sizes / PAPER_N)))]
    chosen = nearest if n is None else largest_or(n, sizes, "n")
    return [sample for sample in found if sample.coordinates["n"] == chosen]


def samples_with_paths(ensemble) -> list[PairSample]:
    """The samples in which two modes were followed along the shear.

    Raises:
        BlockError: the study did not request complex pairs.
    """
    return [sample for sample in pair_samples(ensemble) if len(sample.path)]


def longest_pair(sample: PairSample) -> pd.DataFrame:
    """The path of one exceptional point, as C's Fig. 3 shows it.

    Of the pairs that are born and die where two eigenvalues meet, and whose modes are real at both
    ends of the path and a pair in one interval, the one that is a pair in the most states. If there
    is none, of the pairs that are real at both ends; else of all.
    """
    return _best(sample)[1]


def _best(sample: PairSample) -> tuple[tuple[bool, bool, int], pd.DataFrame]:
    """The path of `longest_pair` with its rank among the paths of all samples."""
    whole = sample.exceptional_points["whole"]
    paths = [
        (_rank(path, bool(whole.get(point, False))), path)
        for point, path in sample.path.groupby("point")
    ]
    return max(paths, key=lambda entry: entry[0])


def _rank(path: pd.DataFrame, coalesces: bool) -> tuple[bool, bool, int]:
    """Whether a path is as in C's Fig. 3, whether it is real at both ends, its states as a pair."""
    pair = is_pair(path).to_numpy()
    both_ends = not pair[[0, -1]].any()
    once = np.count_nonzero(pair[1:] != pair[:-1]) == 2
    return coalesces and both_ends and once, bool(both_ends), int(pair.sum())


def is_pair(path: pd.DataFrame) -> pd.Series:
    """In which states of a path the two modes are a complex pair."""
    return path["imaginary"] > 0.0


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
