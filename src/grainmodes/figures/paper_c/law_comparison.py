"""Complex pairs against strain under several tangential laws; do they grow? (C, Fig. 12(a)).

C shows one eigenpair of harmonic grains with the smoothed Coulomb law; here the mean number of
pairs stands for it, beside the laws without slip, with the sharp Coulomb law, and with springs that
remember their force. Below, the growth rate of released states over the ω_i of their fastest pair.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble import normal_law
from grainmodes.ensemble.law_comparison import comparison_at, points_with_comparison
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_points import POINT, shown
from grainmodes.statistics import averages

COLUMNS = POINT | {
    "kind": ("-", "pairs: mean over the samples; release: one state"),
    "tangential": ("-", "tangential law"),
    "strain": ("1", "strain of the state"),
    "pairs": ("1", "complex pairs of J / M, springs at their threshold slipping"),
    "standard_error": ("1", "standard error of the mean"),
    "pairs_sticking": ("1", "the same, springs at their threshold sticking"),
    "rate": ("1/t_0", "largest omega_i of a released state"),
    "growth": ("1/t_0", "rate at which it leaves"),
    "samples": ("1", "number of samples"),
}

WORDS = {
    "elastic": "elastic",
    "elastic_force": "elastic, force kept",
    "smoothed_coulomb": "smoothed Coulomb",
    "sharp_coulomb": "sharp Coulomb",
    "sharp_coulomb_force": "sharp Coulomb, force kept",
}

NOTE = "dotted: springs at their threshold stick"

SPAN = (-0.15, 1.25)
"""Growth over ω_i that is shown."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """Mean numbers of pairs, and below them the released states, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no variants.
        ValueError: there are none at the n, phi or kt asked for.
    """
    found = points_with_comparison(ensemble)
    if not found:
        return pd.DataFrame(columns=list(COLUMNS))
    point = shown(found, options)
    strain, laws = comparison_at(ensemble, **point)
    parts = [_pairs(law, strain, of) for law, of in laws.items()]
    parts += [_released(law, strain, of) for law, of in laws.items()]
    rows = pd.concat([part for part in parts if len(part)], ignore_index=True)
    return rows.assign(law=normal_law(ensemble), **point).reindex(columns=list(COLUMNS))


def _pairs(law: str, strain: np.ndarray, of: dict[str, np.ndarray]) -> pd.DataFrame:
    slipping, sticking = (
        averages.average(of[name].T, np.isfinite(of[name].T))
        for name in ("pairs_slipping", "pairs_sticking")
    )
    return pd.DataFrame(
        {
            "kind": "pairs",
            "tangential": law,
            "strain": strain,
            "pairs": slipping.mean,
            "standard_error": slipping.standard_error,
            "pairs_sticking": sticking.mean,
            "samples": slipping.samples,
        }
    )


def _released(law: str, strain: np.ndarray, of: dict[str, np.ndarray]) -> pd.DataFrame:
    known = np.isfinite(of["growth"])
    numbers = {name: of[name][known] for name in ("rate", "growth")}
    at = np.broadcast_to(strain, known.shape)[known]
    return pd.DataFrame(
        {"kind": "release", "tangential": law, "strain": at, "samples": 1} | numbers
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Pairs above, growth below, a colour and a symbol per law; open where a force is kept."""
    figure.set_size_inches(3.5, 5.0)
    upper, lower = figure.subplots(2, 1)
    for law, colour, marker in appearance.series(list(WORDS)):
        of = table[table["tangential"] == law]
        _draw_pairs(upper, of[of["kind"] == "pairs"], law, colour, marker)
        release = of[of["kind"] == "release"]
        ratio = (release["growth"] / release["rate"]).clip(*SPAN)
        lower.plot(release["rate"], ratio, marker, color=colour, **appearance.OPEN)
    upper.set(xlabel=r"$\gamma$", ylabel="complex pairs")
    upper.legend(fontsize=6)
    lower.set(xscale="log", xlabel=r"$\omega_i t_0$", ylabel=r"growth / $\omega_i$", ylim=SPAN)
    for level in (0.0, 1.0):
        lower.axhline(level, color="0.6", linewidth=0.5, zorder=1)
    for index, (axes, title) in enumerate(((upper, "pairs"), (lower, "released states"))):
        appearance.name_panel(axes, index, title)
    rows = table[table["kind"] == "pairs"]
    note = f"{rows['law'].iloc[0]} grains; {NOTE}"
    appearance.write_caption(figure, rows, ("n", "phi", "kt"), note)


def _draw_pairs(axes: Axes, of: pd.DataFrame, law: str, colour, marker: str) -> None:
    style = {"color": colour, "markersize": 2.5, "linewidth": 0.7, "elinewidth": 0.5}
    if law.endswith("_force"):
        style |= {"mfc": "none", "mew": 0.6, "markersize": 5.0}
    bars = of["standard_error"]
    axes.errorbar(of["strain"], of["pairs"], bars, marker=marker, label=WORDS[law], **style)
    axes.plot(of["strain"], of["pairs_sticking"], ":", color=colour, linewidth=0.7)
