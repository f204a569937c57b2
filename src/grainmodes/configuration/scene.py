"""A scene: what a study computes, on which grids, and how, as frozen plain values."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, replace

from grainmodes.configuration.grids import Grid, drawable
from grainmodes.parameters.grid import Point, format_value, seed_blocks
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.stages import STAGES


@dataclass(frozen=True)
class Scene:
    """A validated configuration; made by `grainmodes.configuration.scene_from`.

    `law` stands for the tangential stiffness 0 and `law_at` gives it another. A point off the grids
    gets the samples and the observables of the first grid.
    """

    study: str
    grids: tuple[Grid, ...]
    seeds_per_job: int
    law: ContactLaw
    protocol: Protocol
    figures: tuple[str, ...]

    @classmethod
    def from_config(cls, config: dict) -> Scene:
        """The scene of a complete and valid configuration."""
        grids = tuple(map(Grid.from_config, config["grids"]))
        return cls(
            study=config["study"],
            grids=grids,
            seeds_per_job=int(config["seeds_per_job"]),
            law=ContactLaw(**config["contact_law"]),
            protocol=Protocol.from_config(config["protocol"]),
            figures=tuple(config["figures"] if "figures" in config else drawable(grids)),
        )

    @property
    def points(self) -> list[Point]:
        """Every point, grid by grid."""
        return [point for grid in self.grids for point in grid.points]

    def points_of(self, stage: str) -> list[Point]:
        """The points whose grid requests a stage."""
        entry = STAGES[stage]
        return [
            point
            for grid in self.grids
            for point in grid.points
            if entry.is_requested(grid.observables, point.kt)
        ]

    def files_of(self, stage: str) -> list[str]:
        """The files of a stage below the folder of the study, of every point that requests it."""
        entry = STAGES[stage]
        files = []
        for point in self.points_of(stage):
            place = "/".join(f"{name}~{format_value(value)}" for name, value in vars(point).items())
            blocks = [] if entry.single_sample else self.blocks_of(point.n, point.phi, point.kt)
            ends = [f"/seeds~{block}" for block in blocks] or [""]
            files += [f"{entry.output}/{place}{end}.nc" for end in ends]
        return files

    def grid_at(self, n: int, phi: float, kt: float) -> Grid:
        """The grid of a point; the first for a point off the grids."""
        point = Point(n, phi, kt)
        return next((grid for grid in self.grids if grid.holds(point)), self.grids[0])

    def blocks_of(self, n: int, phi: float, kt: float) -> list[str]:
        """Names of the blocks of seeds of a point."""
        return seed_blocks(self.grid_at(n, phi, kt).seeds, self.seeds_per_job)

    def responses(self, n: int, phi: float, kt: float) -> list[str]:
        """Names of the stages that a point requests, beside its packings."""
        return self.grid_at(n, phi, kt).stages(kt)

    def preparation_of(self, n: int, phi: float, kt: float) -> str:
        """How the packings of a point are compressed."""
        return self.grid_at(n, phi, kt).preparation

    def law_at(self, kt: float) -> ContactLaw:
        """The contact law with this tangential stiffness."""
        return replace(self.law, kt=kt)

    def settings(self, stage: str, point: tuple[int, float, float] | None = None) -> str:
        """The part of the scene that a stage depends on, as JSON: the argument of its command.

        Everything a stage ignores stays out, so that changing it does not make the stage again.
        `point` is its (n, φ, k_T/k_N), whose grid holds the observables; that of a stage which
        depends on no observable can be left out.
        """
        entry = STAGES[stage]
        protocol = asdict(self.protocol)
        knows_kt = entry.observable or entry.needs_friction
        part: dict[str, dict[str, object]] = {
            "contact_law": self._law() if knows_kt else {"normal": self.law.normal},
            "protocol": {name: protocol[name] for name in entry.parts("protocol")},
        }
        names = entry.parts("observables")
        if names:
            observables = (self.grid_at(*point) if point else self.grids[0]).observables
            part["observables"] = {name: observables[name] for name in names}
            # A spectrum that no grid requests is made all the same when its path is requested.
            if part["observables"].get("spectrum") == "none":
                part["observables"]["spectrum"] = "modes"
        return json.dumps(part, sort_keys=True)

    def summary(self) -> str:
        """What an ensemble says of the scene that made it, as JSON."""
        protocol = asdict(self.protocol)
        whole = {"study": self.study, "contact_law": self._law(), "protocol": protocol}
        return json.dumps(whole, sort_keys=True)

    def _law(self) -> dict[str, object]:
        return {key: value for key, value in asdict(self.law).items() if key != "kt"}
