"""Complex pairs against strain under several tangential laws, and whether they grow: C, Fig. 12(a).

C shows one eigenpair of harmonic grains with the smoothed Coulomb law. Here the mean number of
complex pairs stands for it, beside that of the laws without slip, with the sharp Coulomb law, and
with springs that remember their force; lines with standard errors: springs at their threshold slip,
dotted lines: they stick. Below, the growth rate of released states over ω_i of their fastest pair,
C (12). A colour and a symbol per law; symbols are open where the force is remembered.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble import contact_law
from grainmodes.ensemble.law_comparison import comparison_at, points_with_comparison
from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import law_values
from grainmodes.figures.shared.selection import Options
from grainmodes.figures.shared.sheared_samples import POINT, choose_point
from grainmodes.statistics import averages

COLUMNS = POINT | {
    "kind": ("-", "pairs: mean over the samples; release: one state"),
    "tangential": ("-", "tangential law"),
    "strain": ("1", "strain of the state"),
    "pairs": ("1", "complex pairs of J / M, springs at their threshold slipping"),
    "standard_error": ("1", "standard error of the mean"),
    "pairs_sticking": ("1", "the same, springs at their threshold sticking"),
    "rate": ("1/t_0", "largest omega_i of a released state"),
    "growth": ("1/t_0", "growth rate of its simulated motion"),
    "samples": ("1", "number of samples of a mean"),
}

LAW_NAMES = {
    "elastic": "elastic",
    "elastic_force": "elastic, force kept",
    "smoothed_coulomb": "smoothed Coulomb",
    "sharp_coulomb": "sharp Coulomb",
    "sharp_coulomb_force": "sharp Coulomb, force kept",
}

NOTE = "dotted: springs at their threshold stick"

RATIO_RANGE = (-0.15, 1.25)
"""Range of growth rate over ω_i that is shown; values beyond lie at its ends."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """Mean numbers of pairs, and below them the released states, with the columns `COLUMNS`.

    Raises:
        BlockError: the ensemble holds no law comparison.
        ValueError: there are none at the requested n, phi or kt.
    """
    points = points_with_comparison(ensemble)
    if not points:
        return pd.DataFrame(columns=list(COLUMNS))
    point = choose_point(points, options)
    strain, laws = comparison_at(ensemble, **point)
    parts = [_mean_pairs(law, strain, samples) for law, samples in laws.items()]
    parts += [_released_states(law, strain, samples) for law, samples in laws.items()]
    rows = pd.concat([part for part in parts if len(part)], ignore_index=True)
    law = law_values(contact_law(ensemble))
    return rows.assign(**law, **point).reindex(columns=list(COLUMNS))


def _mean_pairs(law: str, strain: np.ndarray, samples: dict[str, np.ndarray]) -> pd.DataFrame:
    slipping, sticking = (
        averages.average(samples[name].T, np.isfinite(samples[name].T))
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


def _released_states(law: str, strain: np.ndarray, samples: dict[str, np.ndarray]) -> pd.DataFrame:
    released = np.isfinite(samples["growth"])
    rates = {name: samples[name][released] for name in ("rate", "growth")}
    strain = np.broadcast_to(strain, released.shape)[released]
    return pd.DataFrame({"kind": "release", "tangential": law, "strain": strain} | rates)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "The same packings sheared under several tangential laws: (a) mean number of complex "
        "pairs of M⁻¹J against strain, springs at their threshold slipping (lines with standard "
        "errors) and sticking (dotted); (b) growth rate of released states over ω_i of their "
        "fastest pair, against ω_i. A colour and a symbol per law; open in (a): springs that keep "
        "their force. In (b) a value beyond the range lies at its end.",
        "under which laws complex pairs exist, and under which they grow: 1 in (b) is the growth "
        "of linear theory, 0 is none.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw pairs above and growth rates below."""
    figure.set_size_inches(3.5, 5.0)
    upper, lower = figure.subplots(2, 1)
    for law, colour, marker in appearance.curve_styles(list(LAW_NAMES)):
        rows = table[table["tangential"] == law]
        _draw_pairs(upper, rows[rows["kind"] == "pairs"], law, colour, marker)
        release = rows[rows["kind"] == "release"]
        ratio = (release["growth"] / release["rate"]).clip(*RATIO_RANGE)
        lower.plot(release["rate"], ratio, marker, color=colour, **appearance.OPEN_SYMBOLS)
    upper.set(xlabel=r"$\gamma$", ylabel="complex pairs")
    upper.locator_params(axis="x", nbins=5)
    upper.legend(fontsize=6)
    lower.set(xscale="log", xlabel=r"$\omega_i t_0$")
    lower.set(ylabel=r"growth / $\omega_i$", ylim=RATIO_RANGE)
    for level in (0.0, 1.0):
        lower.axhline(level, color="0.6", linewidth=0.5, zorder=1)
    for index, (axes, title) in enumerate(((upper, "pairs"), (lower, "released states"))):
        labels.name_panel(axes, index, title)
    rows = table[table["kind"] == "pairs"]
    grains = "Hertzian" if rows["law"].iloc[0] == "hertz" else "harmonic"
    note = f"{grains} grains; {NOTE}"
    labels.write_caption(figure, rows, ("n", "phi", "kt"), note)


def _draw_pairs(axes: Axes, rows: pd.DataFrame, law: str, colour, marker: str) -> None:
    style = {"color": colour, "markersize": 2.5, "linewidth": 0.7, "elinewidth": 0.5}
    if law.endswith("_force"):
        style |= {"mfc": "none", "mew": 0.6, "markersize": 5.0}
    bars = rows["standard_error"]
    axes.errorbar(rows["strain"], rows["pairs"], bars, marker=marker, label=LAW_NAMES[law], **style)
    axes.plot(rows["strain"], rows["pairs_sticking"], ":", color=colour, linewidth=0.7)
