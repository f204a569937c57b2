"""What no schema can say of the grids of a scene.

Box. A pair of grains touches twice if two images of one lie within reach d of the other (d: here
the diameter of a large grain, whatever its length). Images differ by a vector of the lattice of the
box, at least L long for every shear strain up to 1/2, so L >= 2 d rules it out. Half the grains
having diameter d and half d/1.4, L^2 = N (pi/8)(1 + 1/1.4^2) d^2 / phi.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import combinations, pairwise

from grainmodes.configuration.grids import Grid
from grainmodes.parameters.spectra import BINNED
from grainmodes.parameters.stages import responses

AREA_PER_GRAIN = math.pi / 8 * (1 + 1 / 1.4**2)
"""Mean area of a grain, in d^2."""

SMALLEST_BOX = 2.0
"""Smallest side of the box, in d."""

MIN_PHI_DIFFERENCE, MIN_KT_RATIO = 1e-9, 1.0 + 1e-9
"""Smallest difference of two φ, and smallest ratio of two k_T, that figures tell apart."""


MAX_FILES = 200_000
"""Largest number of files of one stage: blocks of seeds of all points."""


def grid_conflicts(config: dict) -> Iterator[str]:
    """One sentence per conflict in and between the grids of a complete configuration."""
    too_many = list(_number_of_files(config))
    if too_many:
        yield from too_many
        return
    wrong_kt = list(_friction(config))
    yield from wrong_kt
    for rule in (_boxes, _blocks, _rattlers, _preparations, _springs_at_rest):
        yield from rule(config)
    yield from _nearly_equal(config, "phi", lambda low, high: high - low < MIN_PHI_DIFFERENCE)
    if not wrong_kt:
        yield from _nearly_equal(config, "kt", lambda low, high: high < low * MIN_KT_RATIO)
        yield from _points(config)


def _number_of_files(config: dict) -> Iterator[str]:
    """The first place where the grids together have too many files of a stage."""
    files = 0
    for place, grid in enumerate(config["grids"]):
        points = len(grid["n"]) * len(grid["phi"]) * len(grid.get("kt") or [0.0])
        files += points * math.ceil(grid["seeds"] / config["seeds_per_job"])
        if files > MAX_FILES:
            yield (
                f"grids[{place}]: expected at most {MAX_FILES} files of seeds in the scene, got "
                f"{files}; raise seeds_per_job, or write several scenes"
            )
            return


def _nearly_equal(config: dict, axis: str, same: Callable[[float, float], bool]) -> Iterator[str]:
    """Two values of an axis at one n that no curve, and no choice of a figure, tells apart."""
    values = sorted(
        {
            (n, value, f"grids[{place}].{axis}")
            for place, grid in enumerate(config["grids"])
            for n in grid["n"]
            for value in grid.get(axis) or [0.0]
        }
    )
    close = [
        f"{key}: expected values that differ, got {low!r} and {high!r}"
        for (n, low, _), (other, high, key) in pairwise(values)
        if n == other and low < high and same(low, high)
    ]
    yield from dict.fromkeys(close)


def _friction(config: dict) -> Iterator[str]:
    friction = config["effects"]["friction"]
    for place, grid in enumerate(config["grids"]):
        kt = grid.get("kt")
        if friction and kt is None:
            yield (
                f"grids[{place}]: key 'kt' is missing, expected a list of numbers, or "
                "effects.friction: false"
            )
        if not friction and kt is not None:
            yield (
                f"grids[{place}].kt: expected no key kt because effects.friction is false, got {kt}"
            )


def _boxes(config: dict) -> Iterator[str]:
    for place, grid in enumerate(config["grids"]):
        for n in grid["n"]:
            yield from narrow_box(f"grids[{place}].n", n, max(grid["phi"]))


def narrow_box(key: str, n: int, phi: float) -> Iterator[str]:
    """A sentence about `key` if the box of n grains at φ is too narrow."""
    fewest = 2 * math.ceil(SMALLEST_BOX**2 * phi / AREA_PER_GRAIN / 2)
    side = math.sqrt(n * AREA_PER_GRAIN / phi)
    if side < SMALLEST_BOX:
        yield (
            f"{key}: expected at least {fewest} grains, because at phi = {phi} a grain can touch "
            f"two images of another in a box narrower than {SMALLEST_BOX} d, got {n} grains in a "
            f"box of {side:.2f} d"
        )


def _points(config: dict) -> Iterator[str]:
    """A point in two grids would have two lists of observables."""
    grids = enumerate(map(Grid.from_config, config["grids"]))
    axes = [(place, (grid.n, grid.phi, grid.kt)) for place, grid in grids]
    for (first, one), (second, other) in combinations(axes, 2):
        common = [sorted({*mine} & {*yours}) for mine, yours in zip(one, other, strict=True)]
        if all(common):
            n, phi, kt = (values[0] for values in common)
            yield (
                f"grids[{second}]: expected every point in one grid only, got n = {n}, "
                f"phi = {phi}, kt = {kt}, which also lies in grids[{first}]"
            )


def _blocks(config: dict) -> Iterator[str]:
    """Grids of the same n share trajectories, so a file of one must do for the other."""
    block = config["seeds_per_job"]
    for (first, one), (second, other) in combinations(enumerate(config["grids"]), 2):
        shared = sorted(set(one["n"]) & set(other["n"]))
        fewer, more = sorted((one["seeds"], other["seeds"]))
        if shared and fewer != more and fewer % block:
            yield (
                f"grids[{second}].seeds: expected {one['seeds']} as in grids[{first}], or the "
                f"smaller of both a multiple of seeds_per_job = {block}, because both share the "
                f"files of n = {shared[0]}, got {other['seeds']}"
            )


def _rattlers(config: dict) -> Iterator[str]:
    for place, grid in enumerate(config["grids"]):
        kind = grid["observables"]["spectrum"]
        if grid["observables"]["rattlers"] and kind not in ("eigenvalues", "modes"):
            yield (
                f"grids[{place}].observables.spectrum: expected eigenvalues or modes because "
                f"observables.rattlers is true, got {kind}"
            )


def _preparations(config: dict) -> Iterator[str]:
    """Compression with friction needs friction, and no curve mixes packings of both kinds."""
    grids = list(enumerate(config["grids"]))
    for place, grid in grids:
        if grid["preparation"] == "frictional" and 0.0 in grid.get("kt", [0.0]):
            yield (
                f"grids[{place}].preparation: expected 'frictionless' at kt = 0, got 'frictional'"
            )
    for (first, one), (second, other) in combinations(grids, 2):
        shared = sorted(set(one["n"]) & set(other["n"]))
        if shared and one["preparation"] != other["preparation"]:
            yield (
                f"grids[{second}].preparation: expected {one['preparation']!r} as in "
                f"grids[{first}], because both hold n = {shared[0]}, got {other['preparation']!r}"
            )


def _springs_at_rest(config: dict) -> Iterator[str]:
    """Compression with friction loads the springs, so that J is not symmetric."""
    for place, grid in enumerate(config["grids"]):
        if grid["preparation"] == "frictionless":
            continue
        why = "because preparation is 'frictional' and loads the springs"
        observables = grid["observables"]
        for stage in responses():
            if stage.needs_springs_at_rest and observables[stage.observable]:
                yield f"grids[{place}].observables.{stage.observable}: expected false {why}"
        if observables["spectrum"] in BINNED:
            yield (
                f"grids[{place}].observables.spectrum: expected none, eigenvalues or modes {why}, "
                f"got {observables['spectrum']}"
            )
