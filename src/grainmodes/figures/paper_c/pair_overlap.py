"""Scalar products ⟨u^m|u^n⟩ of eigenvectors around exceptional points: C, Figs. 2 and 3.

Left, (a): one mode with all others among a few grains, in colour the mode that becomes parallel to
it. Right, (b): the two modes of a pair among many grains from birth to death; from above their
scalar product, the real and the imaginary parts of their eigenvalues. Dashed vertical lines: birth
and death.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble import contact_law
from grainmodes.ensemble.exceptional import PairSample
from grainmodes.figures.shared import labels
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import law_values
from grainmodes.figures.shared.pair_samples import (
    EIGENVALUES,
    FIRST,
    SAMPLE,
    SECOND,
    choose_sample,
    draw_eigenvalues,
    longest_pair,
    mark_ends,
    samples_with_paths,
)
from grainmodes.figures.shared.selection import Options

COLUMNS = {
    **SAMPLE,
    "strain": ("1", "strain of the state"),
    "mode": ("1", "number of the mode among few grains; NaN: a pair among many"),
    "other": ("1", "number of the mode it is multiplied with"),
    "product": ("1", "scalar product of the two eigenvectors"),
    **EIGENVALUES,
}

PARALLEL = 1.0 - 1e-9
"""Scalar product above which two modes of norm 1 count as parallel."""


def table(ensemble, options: Options) -> pd.DataFrame:
    """Rows of the pair, then rows of all modes among few grains, with the columns `COLUMNS`.

    Raises:
        BlockError: the study did not request complex pairs.
        ValueError: no sample has the requested n, phi, kt or seed.
    """
    found = samples_with_paths(ensemble)
    few = [sample for sample in found if len(sample.products)]
    many = choose_sample([sample for sample in found if not len(sample.products)], options)
    pair = many or choose_sample(few, options)
    parts = [longest_pair(pair).assign(**pair.coordinates)] if pair else []
    if few:
        clearest = max(few, key=_count_parallel_states)
        parts.append(clearest.products.assign(**clearest.coordinates))
    rows = pd.concat(parts) if parts else pd.DataFrame()
    rows = rows.assign(**law_values(contact_law(ensemble)))
    return rows.reindex(columns=list(COLUMNS)).reset_index(drop=True)


def _count_parallel_states(sample: PairSample) -> int:
    """In how many states the mode is parallel to another one."""
    return int((sample.products["product"] > PARALLEL).sum())


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Scalar products of eigenvectors of M⁻¹J, all of norm 1, against strain. With few grains: "
        "one mode with every other, red the mode that becomes parallel to it. With many grains: "
        "the two modes of one pair, from above their scalar product, the real and the imaginary "
        "parts of their eigenvalues. Dashed lines: birth and death of the pair.",
        "the scalar product reaches 1 at birth and death, where the two eigenvectors are one.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the halves for which there are rows."""
    few, pair = table[table["mode"].notna()], table[table["mode"].isna()]
    columns = [part for part in (few, pair) if len(part)]
    figure.set_size_inches(3.6 * len(columns), 4.6)
    halves = figure.subfigures(1, len(columns), squeeze=False)[0]
    for half, part in zip(halves, columns, strict=True):
        if part is few:
            _draw_all_modes(half.subplots(), few)
            half.suptitle(f"(a) $N = {few['n'].iloc[0]:.0f}$: one mode with all others", fontsize=8)
        else:
            _draw_pair(half, pair)
    figure.suptitle(", ".join(labels.constants(table, ("phi", "kt"))))


def _draw_all_modes(axes: Axes, few: pd.DataFrame) -> None:
    partner = few.loc[few["product"].idxmax(), "other"]
    for other, states in few.groupby("other"):
        coloured = {"color": SECOND, "lw": 1.2, "zorder": 3}
        style = coloured if other == partner else {"color": "0.6", "lw": 0.5}
        axes.plot(states["strain"], states["product"], **style)
    mode = few["mode"].iloc[0]
    axes.plot([], [], color=SECOND, label=f"modes {mode:.0f} and {partner:.0f}")
    axes.plot([], [], color="0.6", label=f"mode {mode:.0f} and the others")
    axes.axhline(1.0, color="k", ls="--", lw=0.6)
    axes.set(xlabel=r"$\gamma$", ylabel=r"$\langle u^m | u^n \rangle$", ylim=(0.0, 1.1))
    axes.locator_params(axis="x", nbins=5)
    axes.legend(loc="center right")


def _draw_pair(half, pair: pd.DataFrame) -> None:
    product, real, imaginary = half.subplots(3, 1, sharex=True)
    product.plot(pair["strain"], pair["product"], "o-", color=FIRST, markersize=2.2, lw=0.8)
    product.set(ylabel=r"$\langle u^1 | u^2 \rangle$", ylim=(0.0, 1.1))
    mark_ends(product, pair)
    draw_eigenvalues(real, imaginary, pair)
    imaginary.set(xlabel=r"$\gamma$")
    half.suptitle(f"(b) $N = {pair['n'].iloc[0]:.0f}$: the two modes of a pair", fontsize=8)
    for axes in (product, real, imaginary):
        axes.label_outer()
    half.align_ylabels()
