"""What no schema can say of the observables of a scene: each is computed, and at some point."""

from __future__ import annotations

from collections.abc import Iterator

from grainmodes.parameters.law import COULOMB_LAWS
from grainmodes.parameters.law_comparison import MAX_GRAINS
from grainmodes.parameters.spectra import MAX_DENSE_GRAINS
from grainmodes.parameters.stages import requested, responses


def observable_conflicts(config: dict) -> Iterator[str]:
    """One sentence per conflict between observables and the rest of a complete configuration."""
    for place, grid in enumerate(config["grids"]):
        key, kts = f"grids[{place}]", grid.get("kt") or [0.0]
        yield from _options(f"{key}.observables", grid["observables"])
        yield from _nothing(key, grid["observables"], kts)
        yield from _large(config, key, grid)
    yield from _comparison(config)


def _options(key: str, observables: dict) -> Iterator[str]:
    """An option of a stage that is not requested would be ignored."""
    for stage in responses():
        for option in stage.options:
            if observables[option] and not stage.is_requested(observables, kt=1.0):
                yield (
                    f"{key}.{stage.observable}: expected true because observables.{option} is "
                    "true, got false"
                )


def _nothing(key: str, observables: dict, kts: list[float]) -> Iterator[str]:
    """An observable that exists at no point of the grid, or a point with none."""
    everywhere = requested(observables, kt=1.0)
    if not everywhere:
        yield f"{key}.observables: expected at least one observable, got none"
    absent = [
        stage for stage in everywhere if not any(stage.is_requested(observables, kt) for kt in kts)
    ]
    for stage in absent:
        yield (
            f"{key}.kt: expected a number above 0 because observables.{stage.observable} is true, "
            "and does not exist without friction, got only 0"
        )
    for kt in kts if everywhere and not absent else ():
        if not requested(observables, kt):
            yield (
                f"{key}.kt: expected numbers above 0, because none of the observables of this grid "
                f"exists without friction, got {kt}"
            )


def _large(config: dict, key: str, grid: dict) -> Iterator[str]:
    """A dense spectrum of many grains fills any memory."""
    largest = max(grid["n"])
    requesting = requested(grid["observables"], 1.0)
    spectra = [stage for stage in requesting if stage.work in ("spectrum", "two spectra")]
    dense = config["protocol"]["spectrum"]["method"] == "dense"
    if dense and spectra and largest > MAX_DENSE_GRAINS:
        yield (
            f"protocol.spectrum.method: expected auto, slicing or inertia_counts for spectra of "
            f"more than {MAX_DENSE_GRAINS} grains, got dense and {key}.n = {largest}"
        )


def _comparison(config: dict) -> Iterator[str]:
    requesting = [grid for grid in config["grids"] if grid["observables"]["law_comparison"]]
    if requesting and config["contact_law"]["friction_coefficient"] is None:
        yield (
            "contact_law.friction_coefficient: expected a number above 0 because "
            "observables.law_comparison is true, and a tangential law that has one "
            f"({', '.join(COULOMB_LAWS)}), got none"
        )
    for n in (n for grid in requesting for n in grid["n"] if n > MAX_GRAINS):
        yield (
            f"observables.law_comparison: expected grids of at most {MAX_GRAINS} grains, "
            f"got n = {n}"
        )
