"""The first event of a sample in closer and closer brackets: B, Figs. 11 and 12.

(a): stress against strain around the event, a colour per smallest step Δγ_Th. (b): the last state
before the event (squares) and the first one after it (circles), as distances to γ_c, against Δγ_Th;
γ_c is the middle of the closest bracket, and the lines are ±Δγ_Th.
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
        "The first plastic event of one sample in closer and closer brackets Δγ_Th: (a) stress "
        "against the distance to γ_c, the middle of the closest bracket, a colour per Δγ_Th; (b) "
        "the ends of the bracket, squares before and circles after the event, as distances to γ_c "
        "against Δγ_Th; lines: ±Δγ_Th.",
        "whether the ends in (b) close on γ_c in proportion to Δγ_Th.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both panels."""
    figure.set_size_inches(7.0, 3.0)
    left, right = figure.subplots(1, 2)
    _draw_curves(left, table)
    _draw_ends(right, table)
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
    axes.legend(title=r"$\Delta\gamma_{\rm Th}$", ncols=2)
    labels.name_panel(axes, 0, "stress around the event")


def _draw_ends(axes: Axes, table: pd.DataFrame) -> None:
    """Draw the ends of the brackets on a symmetric logarithmic axis of γ − γ_c."""
    for side, (colour, marker) in SIDES.items():
        ends = table[table["end"] == side]
        style = {"color": colour, "mfc": "none", "label": side}
        axes.plot(ends["min_step"], ends["distance"], marker, **style)
    steps = np.sort(table["min_step"].unique())
    for sign in (-1.0, 1.0):
        name = r"$\pm \Delta\gamma_{\rm Th}$" if sign > 0 else None
        axes.plot(steps, sign * steps, "-", color="0.6", lw=0.7, zorder=0, label=name)
    axes.set_xscale("log")
    axes.set_yscale("symlog", linthresh=steps[0] / 2, linscale=0.5)
    decades = 10.0 ** np.arange(-10, -3, 2)
    axes.set_yticks([*-decades[::-1], 0.0, *decades])
    axes.minorticks_off()
    axes.set_ylim(-4.0 * steps[-1], 4.0 * steps[-1])
    axes.set(xlabel=r"$\Delta\gamma_{\rm Th}$", ylabel=r"$\gamma - \gamma_c$")
    axes.legend(loc="upper left")
    labels.name_panel(axes, 1, "ends of the bracket")
