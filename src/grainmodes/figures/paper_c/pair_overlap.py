"""Scalar products of eigenvectors around exceptional points (C, Figs. 2 and 3).

Left: one mode with all others among a few grains. Right: the two modes of a pair among many, with
their eigenvalues, from birth to death.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.ensemble.exceptional import PairSample
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.paired_samples import (
    EIGENVALUE,
    FIRST,
    SAMPLE_COLUMNS,
    SECOND,
    draw_eigenvalues,
    longest_pair,
    mark_ends,
    shown,
    with_paths,
)
from grainmodes.figures.shared.selection import Options

COLUMNS = SAMPLE_COLUMNS | {
    "strain": ("1", "strain of the state"),
    "mode": ("1", "number of the mode among few grains; NaN: a pair among many"),
    "other": ("1", "number of the mode it is multiplied with"),
    "product": ("1", "scalar product of the two eigenvectors"),
    "real_1": (EIGENVALUE, "real part of the first eigenvalue of the pair"),
    "real_2": (EIGENVALUE, "real part of the second one"),
    "imaginary": (EIGENVALUE, "imaginary part of the first one"),
}


def table(ensemble, options: Options) -> pd.DataFrame:
    """Rows of the pair, then rows of all modes among few grains, with the columns `COLUMNS`.

    Raises:
        BlockError: its study did not ask for complex pairs.
        ValueError: none lies at the n, phi, kt or seed asked for.
    """
    found = with_paths(ensemble)
    few = [sample for sample in found if len(sample.products)]
    many = shown([sample for sample in found if not len(sample.products)], options)
    pair = many or shown(few, options)
    parts = [longest_pair(pair).assign(**pair.coordinates)] if pair else []
    if few:
        most = max(few, key=_clearest)
        parts.append(most.products.assign(**most.coordinates))
    rows = pd.concat(parts) if parts else pd.DataFrame()
    return rows.reindex(columns=list(COLUMNS)).reset_index(drop=True)


def _clearest(sample: PairSample) -> int:
    """In how many states the mode is parallel to another one."""
    return int((sample.products["product"] > 1.0 - 1e-9).sum())


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a) few grains; (b) to (d) product, real and imaginary parts of a pair."""
    few, pair = table[table["mode"].notna()], table[table["mode"].isna()]
    columns = [part for part in (few, pair) if len(part)]
    figure.set_size_inches(3.6 * len(columns), 4.6)
    halves = figure.subfigures(1, len(columns), squeeze=False)[0]
    for half, part in zip(halves, columns, strict=True):
        if part is few:
            _all_modes(half.subplots(), few)
            half.suptitle(f"(a) $N = {few['n'].iloc[0]:.0f}$: one mode with all others", fontsize=8)
        else:
            _one_pair(half, pair)
    row = table.iloc[0]
    figure.suptitle(", ".join(appearance.CONSTANTS[name](row[name]) for name in ("phi", "kt")))


def _all_modes(axes: Axes, few: pd.DataFrame) -> None:
    partner = few.loc[few["product"].idxmax(), "other"]
    for other, of in few.groupby("other"):
        met = other == partner
        style = {"color": SECOND, "lw": 1.2, "zorder": 3} if met else {"color": "0.6", "lw": 0.5}
        axes.plot(of["strain"], of["product"], **style)
    mode = few["mode"].iloc[0]
    axes.plot([], [], color=SECOND, label=f"modes {mode:.0f} and {partner:.0f}")
    axes.plot([], [], color="0.6", label=f"mode {mode:.0f} and the others")
    axes.axhline(1.0, color="k", ls="--", lw=0.6)
    axes.set(xlabel=r"$\gamma$", ylabel=r"$\langle u^m | u^n \rangle$", ylim=(0.0, 1.1))
    axes.locator_params(axis="x", nbins=5)
    axes.legend(loc="center right")


def _one_pair(half, pair: pd.DataFrame) -> None:
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
