"""The first event in closer and closer brackets: the curve, and where it is (B, Figs. 11, 12)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import appearance
from grainmodes.figures.shared.event_detail_rows import (
    AFTER,
    BEFORE,
    SAMPLE,
    caption,
    critical_strain,
    sample,
    with_event,
)
from grainmodes.figures.shared.field_rows import joined
from grainmodes.figures.shared.selection import Options

PAPER_N = 128
SIDES = {"before": (BEFORE, "s"), "after": (AFTER, "o")}

COLUMNS = {
    **SAMPLE,
    "min_step": ("1", "smallest step of the walk"),
    "end": ("", "before, after: the state is that end of its bracket; else empty"),
    "strain": ("1", "strain of a state of the walk"),
    "distance": ("1", "its strain less that of the event in the closest bracket"),
    "stress": ("k_N", "its stress (sigma_xy + sigma_yx) / 2"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """A row per walk and state around its event, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi or kt asked for.
    """
    shown = with_event(event_details, options, PAPER_N)
    return joined((walk for block in shown for walk in _walks(block)), COLUMNS)


def _walks(block: Block):
    of = {name: array[0] for name, array in block.variables.items() if name.startswith("bracket")}
    critical = critical_strain(block)
    for place in np.flatnonzero(of["bracket_kind"]):
        strain, stress = (of[f"bracket_curve_{name}"][place] for name in ("strain", "stress"))
        held = ~np.isnan(strain)
        end = np.full(len(strain), "", object)
        for side in SIDES:
            end[strain == of[f"bracket_strain_{side}"][place]] = side
        columns = {"strain": strain, "distance": strain - critical, "stress": stress, "end": end}
        columns = {name: column[held] for name, column in columns.items()}
        step = of["bracket_min_step"][place]
        yield pd.DataFrame(sample(block) | {"min_step": step} | columns)


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """(a): the curves on top of each other; (b): the ends of the brackets."""
    figure.set_size_inches(7.0, 3.0)
    curve, ends = figure.subplots(1, 2)
    _curves(curve, table)
    _ends(ends, table)
    critical = (table["strain"] - table["distance"]).iloc[0]
    figure.suptitle(caption(table, rf"$\gamma_c = {critical:.11f}$"))


def _curves(axes: Axes, table: pd.DataFrame) -> None:
    steps = sorted(table["min_step"].unique(), reverse=True)
    for place, (step, colour, marker) in enumerate(appearance.series(steps)):
        of, size = table[table["min_step"] == step], 8.0 - 0.8 * place
        style = {"color": colour, "mfc": "none", "mew": 0.6, "markersize": size}
        axes.plot(1e4 * of["distance"], of["stress"], marker, **style, label=f"${_power(step)}$")
    axes.set(xlabel=r"$(\gamma - \gamma_c) \times 10^4$")
    axes.set_ylabel(appearance.modulus_label(r"$\sigma$", table))
    axes.legend(title=r"$\Delta\gamma_{\rm Th}$", ncols=2)
    appearance.name_panel(axes, 0, "stress around the event")


def _ends(axes: Axes, table: pd.DataFrame) -> None:
    """Symmetric logarithmic: below 0 the last state before the event, above it the first after."""
    for side, (colour, marker) in SIDES.items():
        of = table[table["end"] == side]
        axes.plot(of["min_step"], of["distance"], marker, color=colour, mfc="none", label=side)
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
    appearance.name_panel(axes, 1, "ends of the bracket")


def _power(step: float) -> str:
    return appearance.power(float(f"{step:.3g}"))
