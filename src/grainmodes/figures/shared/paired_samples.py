"""The sample with exceptional points that a figure of complex pairs shows."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.exceptional import PairSample, pair_samples
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.selection import Options, first_or, largest_or
from grainmodes.figures.shared.sheared_points import SAMPLE

SAMPLE_COLUMNS = {name: row for name, row in SAMPLE.items() if name != "law"}
EIGENVALUE = "k_N d^(1/2) / m"
UNIT = r"$k_N d^{1/2} / m$"
FIRST, SECOND = "#2166ac", "#b2182b"
"""Colours of the two modes."""


def shown(found: list[PairSample], options: Options) -> PairSample | None:
    """The sample at the n, phi, kt and seed asked for; else the largest ones and the first seed.

    Raises:
        ValueError: there is none at a value asked for.
    """
    asked = {"n": options.n, "phi": options.phi, "kt": options.kt and options.kt[0]}
    for name, value in asked.items():
        if found:
            chosen = largest_or(value, np.unique([s.coordinates[name] for s in found]), name)
            found = [s for s in found if s.coordinates[name] == chosen]
    if not found:
        return None
    seed = first_or(options.seed, np.unique([s.coordinates["seed"] for s in found]), "seed")
    return next(s for s in found if s.coordinates["seed"] == seed)


def with_paths(ensemble) -> list[PairSample]:
    """The samples in which two modes were followed.

    Raises:
        BlockError: its study did not ask for complex pairs.
    """
    return [sample for sample in pair_samples(ensemble) if len(sample.path)]


def longest_pair(sample: PairSample) -> pd.DataFrame:
    """The path of the point whose modes are real before and after, and longest a pair between."""
    paths = [path for _, path in sample.path.groupby("point")]
    return max(paths, key=lambda path: (_between(path), (path["imaginary"] > 0.0).sum()))


def _between(path: pd.DataFrame) -> bool:
    """Whether both birth and death lie in a path."""
    return not (path["imaginary"].iloc[[0, -1]] > 0.0).any()


def draw_eigenvalues(real: Axes, imaginary: Axes, path: pd.DataFrame) -> None:
    """Re λ and Im λ of the two modes against γ, the ends of the pair dashed."""
    for column, sign, colour in (("real_1", 1.0, FIRST), ("real_2", -1.0, SECOND)):
        style = {"color": colour, "markersize": 2.2, "lw": 0.8}
        real.plot(path["strain"], path[column], "o-", **style)
        imaginary.plot(path["strain"], sign * path["imaginary"], "o-", **style)
    real.set(ylabel=rf"$\mathrm{{Re}}\,\lambda$ / ({UNIT})")
    imaginary.set(ylabel=rf"$\mathrm{{Im}}\,\lambda$ / ({UNIT})")
    for axes in (real, imaginary):
        mark_ends(axes, path)


def mark_ends(axes: Axes, path: pd.DataFrame) -> None:
    """Dashed lines between the last real state and the first of a pair, and the other way."""
    pair = (path["imaginary"] > 0.0).to_numpy()
    strain = path["strain"].to_numpy()
    for place in np.flatnonzero(pair[1:] != pair[:-1]):
        axes.axvline(strain[place : place + 2].mean(), color="0.6", ls="--", lw=0.7, zorder=0)


def name_sample(figure: Figure, table: pd.DataFrame, note: str) -> None:
    """Constants of the sample, and a note, on top."""
    row = dict(table.iloc[0])
    row = row | {"n": int(row["n"])}
    parts = [appearance.CONSTANTS[name](row[name]) for name in ("n", "phi", "kt")]
    figure.suptitle(", ".join([*parts, f"sample {row['seed']:.0f}"]) + f"\n{note}")
