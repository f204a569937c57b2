"""A scene: what a study computes, on which grids, and how, as frozen plain values."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, replace

from grainmodes.configuration.grids import Grid, drawable
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.grid import Point, seed_blocks
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.protocol import Protocol
from grainmodes.parameters.release import Release
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.parameters.strain import Shear, StepStrain


@dataclass(frozen=True)
class Scene:
    """A validated configuration; made by `grainmodes.configuration.scene_of`.

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
    def of(cls, config: dict) -> Scene:
        """The scene of a complete and valid configuration."""
        grids, protocol = tuple(map(Grid.of, config["grids"])), config["protocol"]
        return cls(
            study=config["study"],
            grids=grids,
            seeds_per_job=int(config["seeds_per_job"]),
            law=ContactLaw(**config["contact_law"]),
            protocol=Protocol(
                Compression(**protocol["compression"]),
                StepStrain(**protocol["step_strain"]),
                Shear(**protocol["shear"]),
                PairChoices(**protocol["complex_pairs"]),
                Release(
                    **protocol["release"] | {"dampings": tuple(protocol["release"]["dampings"])}
                ),
                Rattlers(**protocol["rattlers"]),
                SpectrumChoices(**protocol["spectrum"]),
            ),
            figures=tuple(config["figures"] if "figures" in config else drawable(grids)),
        )

    @property
    def points(self) -> list[Point]:
        """Every point, grid by grid."""
        return [point for grid in self.grids for point in grid.points]

    @property
    def field_points(self) -> list[Point]:
        """The points of the grids that ask for fields."""
        return [point for grid in self.grids if grid.observables.fields for point in grid.points]

    @property
    def shear_points(self) -> list[Point]:
        """The points of the grids that ask for shear."""
        return [point for grid in self.grids if grid.observables.shear for point in grid.points]

    @property
    def event_detail_points(self) -> list[Point]:
        """The points of the grids that ask for an event detail."""
        return [
            point for grid in self.grids if grid.observables.event_detail for point in grid.points
        ]

    @property
    def release_points(self) -> list[Point]:
        """The points of the grids that ask for a release, those without friction left out."""
        asking = (grid for grid in self.grids if grid.observables.release)
        return [point for grid in asking for point in grid.points if point.kt > 0.0]

    def grid_at(self, n: int, phi: float, kt: float) -> Grid:
        """The grid of a point; the first for a point off the grids."""
        point = Point(n, phi, kt)
        return next((grid for grid in self.grids if grid.holds(point)), self.grids[0])

    def blocks_of(self, n: int, phi: float, kt: float) -> list[str]:
        """Names of the blocks of seeds of a point."""
        return seed_blocks(self.grid_at(n, phi, kt).seeds, self.seeds_per_job)

    def responses(self, n: int, phi: float, kt: float) -> list[str]:
        """Stages that a point asks for, beside its packings and fields."""
        return self.grid_at(n, phi, kt).stages(kt)

    def spectrum_kind(self, n: int, phi: float, kt: float) -> str:
        """The kind of spectrum of a point; modes for one that is made although no grid asks."""
        kind = self.grid_at(n, phi, kt).observables.spectrum
        return "modes" if kind == "none" else kind

    def law_at(self, kt: float) -> ContactLaw:
        """The contact law with this tangential stiffness."""
        return replace(self.law, kt=kt)

    def settings(self, stage: str, kind: str = "modes", coarse_run: bool = False) -> str:
        """The part of the scene that a stage depends on, as JSON: the argument of its command.

        Everything a stage ignores stays out, so that changing it does not make the stage again.
        `kind` is that of the spectrum, `coarse_run` the observable beside the shear.
        """
        law = {key: value for key, value in asdict(self.law).items() if key != "kt"}
        protocol = asdict(self.protocol)
        spectrum = _part(law, protocol, "rattlers", "spectrum")
        parts = {
            "compress": _part({"normal": self.law.normal}, protocol, "compression"),
            "rigidity": _part(law, protocol, "rattlers"),
            "step_strain": _part(law, protocol, "step_strain"),
            "spectrum": spectrum | {"observables": {"spectrum": kind}},
            "spectrum_rattlers": spectrum | {"observables": {"spectrum": kind}},
            "spectrum_hessian": spectrum,
            "fields": _part(law, protocol, "rattlers", "step_strain"),
            "claim_diagnostics": _part(law, protocol, "rattlers", "step_strain"),
            "shear": _part(law, protocol, "shear")
            | {"observables": {"shear": True, "coarse_run": coarse_run}},
            "event_detail": _part(law, protocol, "shear"),
            "complex_pairs": _part(law, protocol, "shear", "complex_pairs"),
            "release": _part(law, protocol, "release"),
            "law_comparison": _part(law, protocol, "shear"),
            "ensemble": _part(law, protocol, *protocol) | {"study": self.study},
        }
        return json.dumps(parts[stage], sort_keys=True)


def _part(law: dict, protocol: dict, *names: str) -> dict:
    return {"contact_law": law, "protocol": {name: protocol[name] for name in names}}
