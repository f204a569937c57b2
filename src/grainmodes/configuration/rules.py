"""What no schema can say of a scene: how its keys go together; its grids: `grid_rules`."""

from __future__ import annotations

import math
from collections.abc import Iterator

from grainmodes.configuration.grid_rules import grid_conflicts
from grainmodes.configuration.grids import Grid, lacking
from grainmodes.parameters.fields import MOST_FOR_ALL_MODES
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.grid import CHECKPOINT_SPACING, LOWEST_CHECKPOINT
from grainmodes.parameters.law import COULOMB_LAWS, ELASTIC_LAWS
from grainmodes.parameters.law_comparison import MAX_GRAINS


def conflicts(config: dict) -> Iterator[str]:
    """One sentence per conflict in a complete configuration that satisfies the schema."""
    found = list(grid_conflicts(config))
    yield from found
    for rule in (_coulomb, _variants, _damped, _steps, _shear):
        yield from rule(config)
    if not found:
        yield from _figures(config)


def _damped(config: dict) -> Iterator[str]:
    frictionless = any(0.0 in grid.get("kt", [0.0]) for grid in config["grids"])
    if config["protocol"]["step_strain"]["relaxation"] == "damped" and frictionless:
        yield (
            "protocol.step_strain.relaxation: expected 'newton' because at kt = 0 grains do not "
            "rotate, got 'damped'"
        )


def _coulomb(config: dict) -> Iterator[str]:
    law = config["contact_law"]
    name, mu = law["tangential"], law["friction_coefficient"]
    if name in ELASTIC_LAWS and mu is not None:
        yield (
            f"contact_law.friction_coefficient: expected none for the tangential law {name!r} "
            f"(only {', '.join(COULOMB_LAWS)} have one), got {mu}"
        )
    if name in COULOMB_LAWS and mu is None:
        yield (
            "contact_law.friction_coefficient: expected a number above 0 for the tangential law "
            f"{name!r}, got none"
        )


def _variants(config: dict) -> Iterator[str]:
    asked = [grid for grid in config["grids"] if grid["observables"]["law_comparison"]]
    if asked and config["contact_law"]["friction_coefficient"] is None:
        yield (
            "contact_law.friction_coefficient: expected a number above 0 because "
            "observables.law_comparison is true, and a tangential law that has one "
            f"({', '.join(COULOMB_LAWS)}), got none"
        )
    for n in (n for grid in asked for n in grid["n"] if n > MAX_GRAINS):
        yield (
            f"observables.law_comparison: expected grids of at most {MAX_GRAINS} grains, "
            f"got n = {n}"
        )


def _steps(config: dict) -> Iterator[str]:
    compression = config["protocol"]["compression"]
    step, start = compression["phi_step"], compression["initial_phi"]
    if not _whole(CHECKPOINT_SPACING / step):
        yield (
            "protocol.compression.phi_step: expected a step that divides "
            f"{CHECKPOINT_SPACING}, such as 1e-4, got {step}"
        )
    elif not _whole((LOWEST_CHECKPOINT - start) / step):
        yield (
            "protocol.compression.initial_phi: expected a value that lies a whole number of "
            f"steps of {step} below {LOWEST_CHECKPOINT}, got {start}"
        )


def _shear(config: dict) -> Iterator[str]:
    shear = config["protocol"]["shear"]
    strain, step, smallest = shear["strain"], shear["step"], shear["min_step"]
    if not _whole(strain / step):
        yield f"protocol.shear.strain: expected a whole number of steps of {step}, got {strain}"
    if step < smallest or not _whole(math.log10(step / smallest)):
        yield (
            f"protocol.shear.min_step: expected {step} divided by 1, 10, 100 and so on, "
            f"got {smallest}"
        )


def _figures(config: dict) -> Iterator[str]:
    grids = [Grid.of(grid) for grid in config["grids"]]
    for name in config.get("figures", []):
        if name not in FIGURES:
            yield f"figures: unknown figure {name!r}, expected one of {', '.join(FIGURES)}"
            continue
        for need in lacking(name, grids):
            yield f"figures: {name!r} needs {NEEDED[need]}, which this scene does not request"


NEEDED = {
    "rigidity": "observables.rigidity: true",
    "spectrum": "observables.spectrum: counts, binned_averages, eigenvalues or modes",
    "modes": "observables.spectrum: binned_averages or modes",
    "rattlers": "observables.rattlers: true",
    "hessian": "observables.hessian: true",
    "fields": "observables.fields: true",
    "shear": "observables.shear: true",
    "coarse_run": "observables.coarse_run: true",
    "event_detail": "observables.event_detail: true",
    "complex_pairs": "observables.complex_pairs: true",
    "release": "observables.release: true",
    "law_comparison": "observables.law_comparison: true",
    "friction": "these observables at a kt above 0",
    "frictionless": "these observables at kt = 0",
    "all_modes": f"these observables at an n of at most {MOST_FOR_ALL_MODES}",
    "several_n": "these observables at more than one n",
    "several_phi": "these observables at more than one phi",
}


def _whole(ratio: float) -> bool:
    return abs(ratio - round(ratio)) < 1e-6 * max(ratio, 1.0)
