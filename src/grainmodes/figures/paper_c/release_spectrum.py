"""Complex pairs of M⁻¹J along a release: the first one dies, later many are born: C, Fig. 8.

(a) imaginary part λ_i of every pair, (b) number of pairs and of real eigenvalues below 0, against
time; vertical lines: end of the growth (dashed) and second instability (dotted).
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import RED
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.release_rows import (
    END_TIME,
    RUN,
    SECOND_TIME,
    ReleasedSample,
    mark_end_and_second,
    one_released_sample,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "time": ("t_0", "time of a spectrum"),
    "imaginary": ("1/t_0^2", "imaginary part of a pair of J / M; NaN: the spectrum has no pair"),
    "pairs": ("1", "complex pairs of the spectrum"),
    "negative": ("1", "real eigenvalues below 0 of the spectrum"),
    **END_TIME,
    **SECOND_TIME,
}


def table(releases: list[Block], options: Options) -> pd.DataFrame:
    """A row per spectrum and pair, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    return joined((_rows(sample) for sample in one_released_sample(releases, options)), COLUMNS)


def _rows(sample: ReleasedSample) -> pd.DataFrame:
    time = sample.values("spectrum_time")
    pairs, negative = (
        np.maximum(sample.values(f"spectrum_{name}"), 0) for name in ("pairs", "negative")
    )
    parts = [
        values[: max(int(number), 1)]
        for values, number in zip(sample.values("spectrum_imaginary"), pairs, strict=True)
    ]
    spectrum = np.repeat(np.arange(len(time)), [len(part) for part in parts])
    series = {
        "time": time[spectrum],
        "imaginary": np.concatenate(parts) if len(parts) else np.zeros(0),
        "pairs": pairs[spectrum],
        "negative": negative[spectrum],
    }
    times = {name: sample.first(name) for name in ("end_time", "second_time")}
    return pd.DataFrame(sample.identity() | series | times)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Complex pairs of M⁻¹J along a release of one sample: (a) imaginary part λ_i of every "
        "pair, (b) number of pairs and of real eigenvalues below 0, against time. Dashed line: "
        "end of the growth; dotted: second instability.",
        "whether the released pair dies when its growth ends, and how many pairs are there after "
        "the second instability.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both panels."""
    figure.set_size_inches(7.0, 2.9)
    parts, numbers = figure.subplots(1, 2)
    parts.semilogy(table["time"], table["imaginary"], "o", color="k", ms=1.8, mfc="none", mew=0.5)
    spectra = table.drop_duplicates("time")
    numbers.plot(spectra["time"], spectra["pairs"], "o-", color="k", ms=3, label="complex pairs")
    if spectra["negative"].any():
        style = {"color": RED, "ms": 3, "label": r"real, $\lambda' < 0$"}
        numbers.plot(spectra["time"], spectra["negative"], "s-", **style)
    for index, (axes, title) in enumerate(((parts, "imaginary parts"), (numbers, "numbers"))):
        mark_end_and_second(axes, table, in_legend=axes is numbers)
        axes.set_xlabel("$t / t_0$")
        labels.name_panel(axes, index, title)
    parts.set_ylabel(labels.modulus_label(r"$\lambda_i$", table))
    numbers.set_ylabel("eigenvalues of $M^{-1}J$")
    numbers.legend(loc="best")
    figure.suptitle(release_caption(table))
