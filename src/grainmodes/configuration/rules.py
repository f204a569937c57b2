"""What no schema can say of a scene: how its keys go together.

Box. A pair of grains touches twice if two images of one lie within reach d of the other (d: the
diameter of a large grain). Images differ by a vector of the lattice of the box, at least L long for
every shear strain up to 1/2, so L >= 2 d rules it out. Half the grains having diameter d and half
d/1.4, L^2 = N (pi/8)(1 + 1/1.4^2) d^2 / phi.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from grainmodes.configuration.scene import lacking
from grainmodes.parameters import CHECKPOINT_SPACING, FIGURES, LOWEST_CHECKPOINT

AREA_PER_GRAIN = math.pi / 8 * (1 + 1 / 1.4**2)
"""Mean area of a grain, in d^2."""

SMALLEST_BOX = 2.0
"""Smallest side of the box, in d."""


def conflicts(config: dict) -> Iterator[str]:
    """One sentence per conflict in a complete configuration that satisfies the schema."""
    missing_kt = list(_friction(config))
    yield from missing_kt
    for rule in (_boxes, _coulomb, _damped, _spectrum, _steps):
        yield from rule(config)
    if not missing_kt:
        yield from _figures(config)


def _boxes(config: dict) -> Iterator[str]:
    phi = max(config["grid"]["phi"])
    fewest = 2 * math.ceil(SMALLEST_BOX**2 * phi / AREA_PER_GRAIN / 2)
    for n in config["grid"]["n"]:
        side = math.sqrt(n * AREA_PER_GRAIN / phi)
        if side < SMALLEST_BOX:
            yield (
                f"grid.n = {n}: at phi = {phi} the box is {side:.2f} d wide and a grain can touch "
                f"two images of another, allowed are boxes of {SMALLEST_BOX} d, so n >= {fewest}"
            )


def _friction(config: dict) -> Iterator[str]:
    friction, kt = config["effects"]["friction"], config["grid"].get("kt")
    if friction and kt is None:
        yield "grid: key 'kt' is missing, needed is a list, or effects.friction: false"
    if not friction and kt is not None:
        yield f"grid.kt = {kt}: effects.friction is false, allowed is a grid without kt"


def _damped(config: dict) -> Iterator[str]:
    kt = config["grid"].get("kt", [0.0])
    if config["protocol"]["step_strain"]["relaxation"] == "damped" and 0.0 in kt:
        yield (
            "protocol.step_strain.relaxation = 'damped': rotation does not exist at kt = 0, "
            "allowed there is newton"
        )


def _coulomb(config: dict) -> Iterator[str]:
    law = config["contact_law"]
    name, mu = law["tangential"], law["friction_coefficient"]
    if name == "elastic" and mu is not None:
        yield (
            f"contact_law.friction_coefficient = {mu}: the tangential law 'elastic' has none, "
            "allowed are smoothed_coulomb and sharp_coulomb with it"
        )
    if name != "elastic" and mu is None:
        yield (
            f"contact_law.friction_coefficient is missing: the tangential law {name!r} needs a "
            "number above 0"
        )


def _spectrum(config: dict) -> Iterator[str]:
    observables, grid = config["observables"], config["grid"]
    asked = observables.get("spectrum_phi", [])
    if asked and observables["spectrum"] == "none":
        yield (
            f"observables.spectrum_phi = {asked}: observables.spectrum is none, allowed with "
            "spectrum_phi are eigenvalues and modes"
        )
    for phi in asked:
        if phi not in grid["phi"]:
            yield f"observables.spectrum_phi: {phi} is not in grid.phi, allowed are {grid['phi']}"


def _steps(config: dict) -> Iterator[str]:
    compression = config["protocol"]["compression"]
    step, start = compression["phi_step"], compression["initial_phi"]
    if not _whole(CHECKPOINT_SPACING / step):
        yield (
            f"protocol.compression.phi_step = {step}: allowed are steps that divide "
            f"{CHECKPOINT_SPACING}, such as 1e-4"
        )
    elif not _whole((LOWEST_CHECKPOINT - start) / step):
        yield (
            f"protocol.compression.initial_phi = {start}: allowed are values a whole number of "
            f"steps of {step} below {LOWEST_CHECKPOINT}"
        )


def _figures(config: dict) -> Iterator[str]:
    for name in config.get("figures", []):
        if name not in FIGURES:
            yield f"figures: unknown figure {name!r}, allowed are {', '.join(FIGURES)}"
            continue
        for need in lacking(name, config):
            yield f"figures: {name!r} needs {NEEDED[need]}, which this scene does not ask for"


NEEDED = {
    "rigidity": "observables.rigidity: true",
    "spectrum": "observables.spectrum: eigenvalues or modes",
    "modes": "observables.spectrum: modes",
    "fields": "observables.fields: true",
    "friction": "a kt above 0",
}


def _whole(ratio: float) -> bool:
    return abs(ratio - round(ratio)) < 1e-6 * max(ratio, 1.0)
