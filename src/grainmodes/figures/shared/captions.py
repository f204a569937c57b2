"""Captions that can stand alone: a text beside every picture.

A figure says in `caption(table)` what it draws and what to look at. What was drawn, which is N, φ,
k_T/k_N, the samples and the contact law, is read from the plotted numbers and from the scene.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import NamedTuple

import pandas as pd

from grainmodes.figures.shared import labels
from grainmodes.parameters.law import ContactLaw

WIDTH = 100
"""Longest line of a caption."""

MAX_LISTED = 8
"""Number of values that are listed one by one; of more, the range is stated."""

NORMAL_WORDS = {
    "hertz": "Hertzian contacts, f_N = k_N ξ^(3/2)",
    "harmonic": "harmonic contacts, f_N = k_N ξ",
}
TANGENTIAL_WORDS = {
    "elastic": "elastic tangential springs without slip",
    "elastic_force": "elastic tangential springs without slip that keep their force",
    "smoothed_coulomb": "smoothed Coulomb friction",
    "sharp_coulomb": "sharp Coulomb friction",
    "sharp_coulomb_force": "sharp Coulomb friction with springs that keep their force",
}
GRID = {
    "n": ("N", "{:.0f}".format),
    "phi": ("φ", labels.fraction),
    "kt": ("k_T/k_N", lambda kt: labels.plain(labels.ratio(kt))),
}
"""Column → its symbol, and how a value of it is written."""


class Caption(NamedTuple):
    """What a figure says of itself.

    Attributes:
        shows: what is drawn: axes, panels, symbols, lines, colours and bars.
        look_at: what the reader should compare or find.
    """

    shows: str
    look_at: str


def caption_text(
    title: str,
    caption: Caption,
    table: pd.DataFrame,
    law: ContactLaw,
    lacking: Sequence[str] = (),
    compressed_with_friction: bool = False,
) -> str:
    """The whole caption: title, what is drawn, of which samples, and what to look at.

    Args:
        table: the plotted numbers, at least one row.
        law: contact law of the scene.
        lacking: what `missing.notes` says of samples that are missing.
        compressed_with_friction: whether the packings were.
    """
    parts = [*_grid_values(table), _samples(table), law_words(table, law)]
    parts += ["packings compressed with friction"] * compressed_with_friction
    drawn = f"Drawn: {'; '.join(parts)}."
    absent = [f"Missing: {listed(lacking)}."] if lacking else []
    return in_paragraphs(f"{title}.", caption.shows, drawn, *absent, f"Look at: {caption.look_at}")


def listed(lines: Sequence[str]) -> str:
    """Lines of a picture as one sentence."""
    return "; ".join(map(labels.plain, lines))


def in_paragraphs(*texts: str) -> str:
    """Texts below each other, an empty line between them, in lines of at most `WIDTH`."""
    filled = (textwrap.fill(text, WIDTH, break_on_hyphens=False) for text in texts)
    return "\n\n".join(filled) + "\n"


def _grid_values(table: pd.DataFrame) -> list[str]:
    """The values of N, φ and k_T/k_N that are drawn."""
    return [
        f"{symbol} = {_listed(sorted(table[name].dropna().unique()), write)}"
        for name, (symbol, write) in GRID.items()
    ]


def _listed(values: list, write: Callable[[float], str]) -> str:
    if len(values) > MAX_LISTED:
        return f"{write(values[0])} to {write(values[-1])} ({len(values)} values)"
    return ", ".join(map(write, values))


def _samples(table: pd.DataFrame) -> str:
    """How many samples stand behind the figure, or the seed of the one that it shows."""
    if "samples" in table:
        return labels.count_samples(table["samples"].dropna())
    samples = table[["n", "phi", "seed"]].drop_duplicates()
    if len(samples) == 1:
        return f"the sample of seed {samples['seed'].iloc[0]:.0f}"
    return labels.count_samples([len(samples)])


def law_words(table: pd.DataFrame, law: ContactLaw) -> str:
    """The contact law, with Coulomb's μ where contacts may slip."""
    if not (table["kt"] > 0).any():
        return f"{NORMAL_WORDS[law.normal]}, no friction"
    compared = "tangential" in table
    tangential = list(table["tangential"].unique()) if compared else [law.tangential]
    words = ", ".join(TANGENTIAL_WORDS[name] for name in tangential)
    if law.friction_coefficient is not None:
        words += f", μ = {law.friction_coefficient:g}"
    return f"{NORMAL_WORDS[law.normal]}; {words}"
