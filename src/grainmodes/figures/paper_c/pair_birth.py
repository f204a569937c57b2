"""Two real eigenvalues meet under shear and a complex pair is born (C, Fig. 1)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.figures.shared.paired_samples import (
    EIGENVALUE,
    SAMPLE_COLUMNS,
    draw_eigenvalues,
    longest_pair,
    name_sample,
    shown,
    with_paths,
)
from grainmodes.figures.shared.selection import Options

COLUMNS = SAMPLE_COLUMNS | {
    "strain": ("1", "strain of the state"),
    "real_1": (EIGENVALUE, "real part of the first eigenvalue of J / M"),
    "real_2": (EIGENVALUE, "real part of the second one"),
    "imaginary": (EIGENVALUE, "imaginary part of the first one; the second has its negative"),
}

AFTER = 20
"""States of the pair that are shown."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """A row per state up to some states after the birth, with the columns `COLUMNS`.

    Raises:
        BlockError: its study did not ask for complex pairs.
        ValueError: none lies at the n, phi, kt or seed asked for.
    """
    sample = shown(with_paths(ensemble), options)
    if sample is None:
        return pd.DataFrame(columns=list(COLUMNS))
    path = longest_pair(sample)
    born = (path["imaginary"] > 0.0).to_numpy().argmax()
    return path.iloc[: born + AFTER].assign(**sample.coordinates)[list(COLUMNS)]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Above the real, below the imaginary parts."""
    figure.set_size_inches(3.6, 4.2)
    real, imaginary = figure.subplots(2, 1, sharex=True)
    draw_eigenvalues(real, imaginary, table)
    imaginary.set(xlabel=r"$\gamma$")
    figure.align_ylabels()
    name_sample(figure, table, "two real modes become a complex pair")
