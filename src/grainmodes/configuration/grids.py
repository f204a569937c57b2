"""The grids of a scene: their points, what is computed at each, and the figures they allow."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product
from types import MappingProxyType

from grainmodes.parameters.fields import MOST_FOR_ALL_MODES
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.grid import Point
from grainmodes.parameters.stage import Observables
from grainmodes.parameters.stages import requested, responses


def offered(observables: Observables) -> set[str]:
    """The words of `parameters.figures` that a grid with these observables satisfies.

    A word is the key of an observable that is on; `spectrum` stands for a spectrum of any kind,
    `modes` for one with eigenvectors or averages of them, and an option counts with its stage.
    """
    words = {stage.observable for stage in responses() if stage.is_requested(observables, kt=1.0)}
    for stage in responses():
        if stage.observable in words:
            words |= {option for option in stage.options if observables[option]}
    if observables["spectrum"] in ("binned_averages", "modes"):
        words.add("modes")
    return words


@dataclass(frozen=True)
class Grid:
    """All combinations of `n`, `phi` and `kt`, with the samples 0 … `seeds` − 1 each.

    `preparation` is one of `parameters.compression.PREPARATIONS`.
    """

    n: tuple[int, ...]
    phi: tuple[float, ...]
    kt: tuple[float, ...]
    seeds: int
    observables: Observables
    preparation: str

    @classmethod
    def from_config(cls, config: dict) -> Grid:
        """The grid of a complete and valid item of `grids`; without friction k_T is 0."""
        return cls(
            n=tuple(map(int, config["n"])),
            phi=tuple(map(float, config["phi"])),
            kt=tuple(map(float, config.get("kt", [0.0]))),
            seeds=int(config["seeds"]),
            observables=MappingProxyType(dict(config["observables"])),
            preparation=config["preparation"],
        )

    @property
    def points(self) -> list[Point]:
        """Its points, k_T running fastest."""
        return [Point(*values) for values in product(self.n, self.phi, self.kt)]

    def holds(self, point: Point) -> bool:
        """Whether the point is one of them."""
        return point.n in self.n and point.phi in self.phi and point.kt in self.kt

    def stages(self, kt: float) -> list[str]:
        """Names of the stages that a point with this k_T requests."""
        return [stage.name for stage in requested(self.observables, kt)]


TOGETHER = {
    "friction": lambda grids: any(kt > 0.0 for grid in grids for kt in grid.kt),
    "frictionless": lambda grids: any(kt == 0.0 for grid in grids for kt in grid.kt),
    "all_modes": lambda grids: any(n <= MOST_FOR_ALL_MODES for grid in grids for n in grid.n),
    "several_n": lambda grids: len({n for grid in grids for n in grid.n}) > 1,
    "several_phi": lambda grids: len({phi for grid in grids for phi in grid.phi}) > 1,
}
"""What a figure may need of all grids together that have its observables."""


def drawable(grids: Iterable[Grid]) -> list[str]:
    """Names of the figures that grids allow."""
    return [name for name in FIGURES if not lacking(name, grids)]


def lacking(figure: str, grids: Iterable[Grid]) -> list[str]:
    """What a figure needs and the grids do not ask for, in the order of the figure.

    The observables must meet in one grid; grids in which they do have the rest together.
    """
    needs = FIGURES[figure].observables
    observables = {word for word in needs if word not in TOGETHER}
    having = [grid for grid in grids if observables <= offered(grid.observables)]
    if having:
        return [word for word in needs if word in TOGETHER and not TOGETHER[word](having)]
    nowhere = observables.difference(*(offered(grid.observables) for grid in grids))
    return [word for word in needs if word in (nowhere or observables)]
