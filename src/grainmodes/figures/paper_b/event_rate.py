"""The non-affine displacement rate dq̊/dγ just after an event: B, Fig. 5.

Two maps on one scale: left by linear response, B (41), right by a simulated step, B (13), (14).
Arrows are displacements per unit strain, colours rotations per unit strain.
"""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import event_maps, step_strain_maps
from grainmodes.figures.shared.captions import Caption
from grainmodes.figures.shared.grain_rows import field_columns
from grainmodes.figures.shared.map_scale import Scale
from grainmodes.figures.shared.selection import Options

VARIABLES = {"theory": "rate", "simulation": "rate_simulated"}
TITLES = {"theory": "linear response", "simulation": "simulation"}

COLUMNS = {
    **event_maps.COLUMNS,
    "strain_step": ("1", "size of the simulated step"),
    **field_columns("theory", "d", "non-affine displacement per unit strain by linear response"),
    **field_columns("simulation", "d", "the same from a relaxed step; empty: carries no load"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """The field in theory and simulation, grain by grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the requested n, phi or kt.
    """
    return event_maps.event_field_rows(
        event_details, options, VARIABLES, COLUMNS, strain_step=_step
    )


def _step(block: Block) -> float:
    return block.mapping("config")["rate"]


def caption(table: pd.DataFrame) -> Caption:
    """What is drawn, and what to look at."""
    return Caption(
        "Non-affine displacement rate dq̊/dγ of every grain just after a plastic event: (a) "
        "linear response, B (41), (b) a simulated step. Arrows: displacements, colours: "
        "rotations, per unit strain and both on one scale.",
        "whether both maps are one picture.",
    )


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Draw both maps."""
    figure.set_size_inches(7.0, 3.9)
    figure.set_layout_engine("compressed")
    scales = dict.fromkeys(VARIABLES, Scale.from_fields(table, tuple(VARIABLES), arrow=1.2))
    note = f"arrows: displacement per unit strain, {event_maps.event_strain_label(table)}"
    step_strain_maps.draw_two_maps(figure, table, TITLES, scales, note)
