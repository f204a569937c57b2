"""What no schema can say of a scene: how its grids, laws, choices and figures go together.

Rules within and between grids stand in `grid_rules`, those of observables in `observable_rules`,
those of laws and choices in `choice_rules`.
"""

from __future__ import annotations

from collections.abc import Iterator

from grainmodes.configuration.choice_rules import choice_conflicts
from grainmodes.configuration.grid_rules import grid_conflicts
from grainmodes.configuration.grids import Grid, lacking
from grainmodes.configuration.observable_rules import observable_conflicts
from grainmodes.parameters.fields import MOST_FOR_ALL_MODES
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.stages import responses


def conflicts(config: dict) -> Iterator[str]:
    """One sentence per conflict in a complete configuration that satisfies the schema."""
    found = list(grid_conflicts(config))
    yield from found
    yield from choice_conflicts(config, {kt for grid in config["grids"] for kt in _kts(grid)})
    yield from observable_conflicts(config)
    if not found:
        yield from _figures(config)


def _kts(grid: dict) -> list[float]:
    return grid.get("kt", [0.0])


def _figures(config: dict) -> Iterator[str]:
    grids = [Grid.from_config(grid) for grid in config["grids"]]
    for name in config.get("figures", []):
        if name not in FIGURES:
            yield f"figures: unknown figure {name!r}, expected one of {', '.join(FIGURES)}"
            continue
        for need in lacking(name, grids):
            yield f"figures: {name!r} needs {NEEDED[need]}, which this scene does not request"


NEEDED = {
    **{
        key: f"observables.{key}: true"
        for stage in responses()
        for key in (stage.observable, *stage.options)
    },
    "spectrum": "observables.spectrum: counts, binned_averages, eigenvalues or modes",
    "modes": "observables.spectrum: binned_averages or modes",
    "friction": "these observables at a kt above 0",
    "frictionless": "these observables at kt = 0",
    "all_modes": f"these observables at an n of at most {MOST_FOR_ALL_MODES}",
    "several_n": "these observables at more than one n",
    "several_phi": "these observables at more than one phi",
}
"""Word of `parameters.figures` → what a scene must say to satisfy it."""
