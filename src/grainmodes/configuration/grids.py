"""The grids of a scene: their points, what is computed at each, and the figures they allow."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

from grainmodes.parameters.fields import MOST_FOR_ALL_MODES
from grainmodes.parameters.figures import FIGURES
from grainmodes.parameters.grid import Point


@dataclass(frozen=True)
class Observables:
    """What is computed from every packing of a grid."""

    rigidity: bool = True
    step_strain: bool = True
    spectrum: str = "modes"
    rattlers: bool = False
    hessian: bool = False
    fields: bool = False
    claim_diagnostics: bool = False
    shear: bool = False
    coarse_run: bool = False
    event_detail: bool = False
    complex_pairs: bool = False
    release: bool = False
    law_comparison: bool = False

    @property
    def words(self) -> set[str]:
        """What they offer to a figure."""
        offered = {
            "rigidity": self.rigidity,
            "spectrum": self.spectrum != "none",
            "modes": self.spectrum in ("binned_averages", "modes"),
            "rattlers": self.rattlers,
            "hessian": self.hessian,
            "fields": self.fields,
            "shear": self.shear,
            "coarse_run": self.shear and self.coarse_run,
            "event_detail": self.event_detail,
            "complex_pairs": self.complex_pairs,
            "release": self.release,
            "law_comparison": self.law_comparison,
        }
        return {word for word, here in offered.items() if here}


@dataclass(frozen=True)
class Grid:
    """All combinations of `n`, `phi` and `kt`, with the samples 0 … `seeds` − 1 each."""

    n: tuple[int, ...]
    phi: tuple[float, ...]
    kt: tuple[float, ...]
    seeds: int
    observables: Observables

    @classmethod
    def of(cls, config: dict) -> Grid:
        """The grid of a complete and valid item of `grids`; without friction k_T is 0."""
        return cls(
            n=tuple(map(int, config["n"])),
            phi=tuple(map(float, config["phi"])),
            kt=tuple(map(float, config.get("kt", [0.0]))),
            seeds=int(config["seeds"]),
            observables=Observables(**config["observables"]),
        )

    @property
    def points(self) -> list[Point]:
        """Its points, k_T running fastest."""
        return [Point(*values) for values in product(self.n, self.phi, self.kt)]

    def holds(self, point: Point) -> bool:
        """Whether the point is one of them."""
        return point.n in self.n and point.phi in self.phi and point.kt in self.kt

    def stages(self, kt: float) -> list[str]:
        """Stages that a point with this k_T asks for, beside packings and single samples.

        Without rotation the effective Hessian is J, and there is nothing to probe or to release.
        """
        asked = self.observables
        wanted = {
            "rigidity": asked.rigidity,
            "step_strain": asked.step_strain,
            "spectrum": asked.spectrum != "none",
            "spectrum_rattlers": asked.rattlers,
            "spectrum_hessian": asked.hessian and kt > 0.0,
            "claim_diagnostics": asked.claim_diagnostics and kt > 0.0,
            "shear": asked.shear,
            "complex_pairs": asked.complex_pairs and kt > 0.0,
            "release": asked.release and kt > 0.0,
            "law_comparison": asked.law_comparison and kt > 0.0,
        }
        return [stage for stage, here in wanted.items() if here]


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
    having = [grid for grid in grids if observables <= grid.observables.words]
    if having:
        return [word for word in needs if word in TOGETHER and not TOGETHER[word](having)]
    nowhere = observables.difference(*(grid.observables.words for grid in grids))
    return [word for word in needs if word in (nowhere or observables)]
