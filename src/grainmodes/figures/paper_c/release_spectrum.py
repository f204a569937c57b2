"""Complex pairs of M⁻¹J along a release: the first one dies, later many are born: C, Fig. 8.

(a) imaginary part λ_i of every pair, (b) λ_i of the released pair, over that of the start, which is
the inset of C, (c) number of pairs and of real eigenvalues below 0, against the logarithm of time;
vertical lines: end of the growth (dashed) and second instability (dotted).
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.appearance import BLUE, RED
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.release_rows import (
    END_TIME,
    RUN,
    SECOND_TIME,
    ReleasedState,
    mark_end_and_second,
    one_released_state,
    release_caption,
)
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **RUN,
    "kind": ("", "spectrum: a pair of a spectrum; released: the released pair, followed"),
    "time": ("t_0", "time of a spectrum, or at which the released pair was sought"),
    "imaginary": (
        "1/t_0^2",
        "imaginary part of a pair of J / M; NaN: there is none; 0: the pair is dead",
    ),
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
    return joined((_rows(state) for state in one_released_state(releases, options)), COLUMNS)


def _rows(state: ReleasedState) -> pd.DataFrame:
    time = state.values("spectrum_time")
    pairs, negative = (
        np.maximum(state.values(f"spectrum_{name}"), 0) for name in ("pairs", "negative")
    )
    parts = [
        values[: max(int(number), 1)]
        for values, number in zip(state.values("spectrum_imaginary"), pairs, strict=True)
    ]
    spectrum = np.repeat(np.arange(len(time)), [len(part) for part in parts])
    series = {
        "time": time[spectrum],
        "imaginary": np.concatenate(parts) if len(parts) else np.zeros(0),
        "pairs": pairs[spectrum],
        "negative": negative[spectrum],
    }
    followed = {"time": state.values("pair_time"), "imaginary": state.values("pair_imaginary")}
    rows = pd.concat(
        [
            pd.DataFrame(state.identity() | {"kind": "spectrum"} | series),
            pd.DataFrame(state.identity() | {"kind": "released"} | followed),
        ],
        ignore_index=True,
    )
    times = {name: state.first(name) for name in ("end_time", "second_time")}
    return rows.assign(**times)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Complex pairs of M⁻¹J along a release of one state, without damping: (a) imaginary part "
        "λ_i of every pair, (b) λ_i of the pair that was released over that of the start, 0 where "
        "it is dead, (c) number of pairs and of real eigenvalues below 0, against time on a "
        "logarithmic axis. Dashed line: end of the growth; dotted: second instability.",
        "the released pair dies when its growth ends, and many pairs are born before the second "
        "instability.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the three panels."""
    figure.set_size_inches(7.0, 2.9)
    parts, released, numbers = figure.subplots(1, 3)
    shown = table[table["time"] > 0.0]
    spectra, followed = (shown[shown["kind"] == kind] for kind in ("spectrum", "released"))
    style = {"ms": 1.8, "mfc": "none", "mew": 0.5}
    parts.plot(spectra["time"], spectra["imaginary"], "o", color="k", **style)
    parts.set_yscale("log")
    start = table.loc[table["kind"] == "released", "imaginary"]
    released.plot(
        followed["time"], followed["imaginary"] / start.iloc[0], ".-", color=RED, ms=2.5, lw=0.6
    )
    once = spectra.drop_duplicates("time")
    numbers.plot(once["time"], once["pairs"], "o-", color="k", ms=2.5, label="complex pairs")
    if once["negative"].any():
        style = {"color": BLUE, "ms": 2.5, "label": r"real, $\lambda' < 0$"}
        numbers.plot(once["time"], once["negative"], "s-", **style)
    titles = ("all pairs", "the released pair", "numbers")
    for index, (axes, title) in enumerate(zip((parts, released, numbers), titles, strict=True)):
        mark_end_and_second(axes, table, in_legend=axes is numbers)
        axes.set(xscale="log", xlabel="$t / t_0$")
        labels.name_panel(axes, index, title)
    parts.set_ylabel(r"$\lambda_i\,t_0^2$")
    released.set_ylabel(r"$\lambda_i / \lambda_i(0)$")
    numbers.set_ylabel("eigenvalues of $M^{-1}J$")
    entries = numbers.get_legend_handles_labels()
    figure.legend(*entries, loc="outside lower center", ncols=4)
    figure.suptitle(release_caption(table))
