"""Complex pairs of M⁻¹J along a release: one dies, later many are born (C, Fig. 8)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.release_rows import COLUMNS as RUN
from grainmodes.figures.shared.release_rows import Sample, caption, mark_moments, one
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a spectrum"),
    "imaginary": ("k_N", "imaginary part of a pair of J / M; NaN: it has none"),
    "pairs": ("1", "complex pairs of the spectrum"),
    "negative": ("1", "real eigenvalues below 0 of the spectrum"),
    "end_time": ("t_0", "when M leaves its law"),
    "second_time": ("t_0", "when the second instability begins"),
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """A row per spectrum and pair, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi, kt or seed asked for.
    """
    return joined((_rows(sample) for sample in one(releases, options)), COLUMNS)


def _rows(sample: Sample) -> pd.DataFrame:
    time = sample.of("spectrum_time")
    counts = [np.maximum(sample.of(f"spectrum_{name}"), 0) for name in ("pairs", "negative")]
    parts = [
        values[: max(int(pairs), 1)]
        for values, pairs in zip(sample.of("spectrum_imaginary"), counts[0], strict=True)
    ]
    place = np.repeat(np.arange(len(time)), [len(part) for part in parts])
    moments = {f"{name}_time": sample.of(f"{name}_time")[0] for name in ("end", "second")}
    series = {
        "time": time[place],
        "imaginary": np.concatenate(parts) if len(parts) else np.zeros(0),
        "pairs": counts[0][place],
        "negative": counts[1][place],
    }
    return pd.DataFrame(sample.columns() | series | moments)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a) every imaginary part; (b) how many pairs, and how many eigenvalues below 0."""
    figure.set_size_inches(7.0, 2.9)
    parts, numbers = figure.subplots(1, 2)
    parts.semilogy(table["time"], table["imaginary"], "o", color="k", ms=1.8, mfc="none", mew=0.5)
    once = table.drop_duplicates("time")
    numbers.plot(once["time"], once["pairs"], "o-", color="k", ms=3, label="complex pairs")
    if once["negative"].any():
        numbers.plot(
            once["time"], once["negative"], "s-", color=BELOW, ms=3, label=r"real, $\lambda' < 0$"
        )
    for place, axes in enumerate((parts, numbers)):
        mark_moments(axes, table, label=axes is numbers)
        axes.set_xlabel("$t / t_0$")
        appearance.name_panel(axes, place, ("imaginary parts", "numbers")[place])
    parts.set_ylabel(appearance.modulus_label(r"$\lambda_i$", table))
    numbers.set_ylabel("eigenvalues of $M^{-1}J$")
    numbers.legend(loc="best")
    figure.suptitle(caption(table))


BELOW = appearance.TRANSLATIONAL
"""Colour of real eigenvalues below 0."""
