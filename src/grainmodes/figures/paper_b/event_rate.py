"""dq̊/dγ just after an event by linear response and by a simulated step (B, Fig. 5)."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure

from grainmodes.dataset.files import Block
from grainmodes.figures.shared import event_maps, step_strain_maps
from grainmodes.figures.shared.field_rows import described
from grainmodes.figures.shared.grain_maps import Scale
from grainmodes.figures.shared.selection import Options

VARIABLES = {"theory": "rate", "simulation": "rate_simulated"}
TITLES = {"theory": "linear response", "simulation": "simulation"}

COLUMNS = {
    **event_maps.COLUMNS,
    "strain_step": ("1", "size of the simulated step"),
    **described("theory", "d", "non-affine displacement per unit strain by linear response"),
    **described("simulation", "d", "the same from a relaxed step; empty: carries no load"),
}


def table(event_details: list[Block], options: Options) -> pd.DataFrame:
    """The field in theory and simulation, grain by grain, with the columns `COLUMNS`.

    Raises:
        ValueError: no sample has the n, phi or kt asked for.
    """
    return event_maps.rows(event_details, options, VARIABLES, COLUMNS, strain_step=_step)


def _step(block: Block) -> float:
    return block.mapping("config")["rate"]


def draw(figure: Figure, table: pd.DataFrame) -> None:
    """Two maps on one scale."""
    figure.set_size_inches(7.0, 3.9)
    figure.set_layout_engine("compressed")
    scale = Scale.of(table, tuple(VARIABLES), arrow=1.2)
    note = f"arrows: displacement per unit strain, {event_maps.at_event(table)}"
    step_strain_maps.draw_pair(figure, table, TITLES, dict.fromkeys(VARIABLES, scale), note)
