"""The first event of a sample in closer and closer brackets: B, Figs. 11 and 12.

(a): stress against strain around the event, a colour per smallest step Δγ_Th. (b): the bracket of
every Δγ_Th, from the last state before the event (square) to the first one after it (circle). (c):
how far the middle of every bracket lies from γ_c, which is the middle of the closest one; the line
is Δγ_Th/2, the most by which nested brackets may differ.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance, labels
from grainmodes.figures.shared.appearance import AFTER, BEFORE
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.columns import RIGIDITY_UNIT
from grainmodes.figures.shared.event_rows import SAMPLE, critical_strain, identity, sample_with
from grainmodes.figures.shared.sample_files import joined
from grainmodes.figures.shared.selection import Options

PAPER_N = 128
SIDES = {"before": (BEFORE, "s"), "after": (AFTER, "o")}

COLUMNS = {
    **SAMPLE,
    "min_step": ("1", "smallest step of the shear"),
    "end": ("", "before, after: the state is that end of its bracket; else empty"),
    "strain": ("1", "strain of a state of the shear"),
    "distance": ("1", "its strain minus that of the event in the closest bracket"),
    "stress": (RIGIDITY_UNIT, "its stress (sigma_xy + sigma_yx) / 2"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """A row per shear and state around its event, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    shown = sample_with("event_count", event_details, options, PAPER_N)
    return joined((rows for block in shown for rows in _rows_of_shears(block)), COLUMNS)


def _rows_of_shears(block: Block) -> Iterator[pd.DataFrame]:
    """The states around the event in the shear of each smallest step that found one."""
    sample = {name: array[0] for name, array in block.variables.items()}
    critical = critical_strain(block)
    for shear in np.flatnonzero(sample["bracket_kind"]):
        strain, stress = (sample[f"bracket_curve_{name}"][shear] for name in ("strain", "stress"))
        end = np.full(len(strain), "", object)
        for side in SIDES:
            end[strain == sample[f"bracket_strain_{side}"][shear]] = side
        columns = {"strain": strain, "distance": strain - critical, "stress": stress, "end": end}
        known = ~np.isnan(strain)
        columns = {name: column[known] for name, column in columns.items()}
        step = {"min_step": sample["bracket_min_step"][shear]}
        yield pd.DataFrame(identity(block) | step | columns)


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "The first plastic event of one sample in closer and closer brackets: (a) stress against "
        "the distance to γ_c, the middle of the closest bracket, a colour per smallest step "
        "Δγ_Th; (b) the bracket of every Δγ_Th, from the last state before the event (square) to "
        "the first one after it (circle); (c) distance of the middle of every bracket from γ_c, "
        "double logarithmic, with the line Δγ_Th/2.",
        "whether the symbols of (c) lie on the line or below it, so that γ_c converges with "
        "Δγ_Th; a bracket of (b) that does not hold γ_c had its event at another strain, as its "
        "steps were larger.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw the three panels."""
    figure.set_size_inches(7.0, 3.2)
    curves, brackets, convergence = figure.subplots(1, 3)
    _draw_curves(curves, table)
    ends = table[table["end"] != ""].pivot(index="min_step", columns="end", values="distance")
    _draw_ends(brackets, ends)
    _draw_convergence(convergence, ends)
    entries = curves.get_legend_handles_labels()
    title = r"(a): $\Delta\gamma_{\rm Th}$"
    figure.legend(*entries, title=title, loc="outside lower center", ncols=len(entries[0]))
    critical = (table["strain"] - table["distance"]).iloc[0]
    figure.suptitle(labels.sample_caption(table, rf"$\gamma_c = {critical:.11f}$"))


def _draw_curves(axes: Axes, table: pd.DataFrame) -> None:
    """Draw the stress of every shear; symbols shrink with Δγ_Th, as the curves coincide."""
    steps = sorted(table["min_step"].unique(), reverse=True)
    for index, (step, colour, marker) in enumerate(appearance.curve_styles(steps)):
        curve = table[table["min_step"] == step]
        style = {"color": colour, "mfc": "none", "mew": 0.6, "markersize": 8.0 - 0.8 * index}
        label = f"${labels.power(step, 3)}$"
        axes.plot(1e4 * curve["distance"], curve["stress"], marker, **style, label=label)
    axes.set(xlabel=r"$(\gamma - \gamma_c) \times 10^4$")
    axes.set_ylabel(labels.modulus_label(r"$\sigma$", table))
    labels.name_panel(axes, 0, "stress around the event")


def _draw_ends(axes: Axes, ends: pd.DataFrame) -> None:
    """Draw a bar from end to end of every bracket, with its two states."""
    axes.vlines(ends.index, 1e4 * ends["before"], 1e4 * ends["after"], color="0.5", lw=0.9)
    for side, (colour, marker) in SIDES.items():
        end = 1e4 * ends[side]
        axes.plot(ends.index, end, marker, color=colour, mfc="none", markersize=4.0, label=side)
    axes.axhline(0.0, color="0.6", lw=0.6, zorder=0)
    axes.set(xscale="log", xlabel=r"$\Delta\gamma_{\rm Th}$")
    axes.set(ylabel=r"$(\gamma - \gamma_c) \times 10^4$")
    axes.legend(loc="best")
    labels.name_panel(axes, 1, "brackets")


def _draw_convergence(axes: Axes, ends: pd.DataFrame) -> None:
    """Draw the distance of every bracket's middle to γ_c, but that of the closest bracket."""
    middle = (ends["before"] + ends["after"]).abs() / 2.0
    middle = middle[(middle.index > ends.index.min()) & (middle > 0.0)]
    axes.loglog(middle.index, middle, "D", color="0.15", mfc="none", markersize=4.0)
    steps = ends.index.to_numpy()
    axes.loglog(steps, steps / 2.0, "-", color="0.6", lw=0.8, label=r"$\Delta\gamma_{\rm Th}/2$")
    axes.set(
        xlabel=r"$\Delta\gamma_{\rm Th}$", ylabel=r"$|\gamma_c(\Delta\gamma_{\rm Th}) - \gamma_c|$"
    )
    axes.legend(loc="upper left")
    labels.name_panel(axes, 2, r"convergence of $\gamma_c$")
