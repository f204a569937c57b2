"""A scene: what a study computes, on which grid, and how, as frozen plain values."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, replace

from grainmodes.parameters import (
    FIGURES,
    Compression,
    ContactLaw,
    Protocol,
    Rattlers,
    StepStrain,
    seed_blocks,
)


@dataclass(frozen=True)
class Scene:
    """A validated configuration; made by `grainmodes.configuration.scene_of`.

    `law` stands for the tangential stiffness 0 and `law_at` gives it another. `spectrum_phi` are
    the area fractions that get a spectrum, none where `spectrum` is "none".
    """

    study: str
    n: tuple[int, ...]
    phi: tuple[float, ...]
    kt: tuple[float, ...]
    seeds: int
    block: int
    law: ContactLaw
    rigidity: bool
    step_strain: bool
    spectrum: str
    spectrum_phi: tuple[float, ...]
    protocol: Protocol
    figures: tuple[str, ...]

    @classmethod
    def of(cls, config: dict) -> Scene:
        """The scene of a complete and valid configuration."""
        grid, observables = config["grid"], config["observables"]
        phi = tuple(map(float, grid["phi"]))
        spectrum_phi = tuple(map(float, observables.get("spectrum_phi", phi)))
        protocol = config["protocol"]
        return cls(
            study=config["study"],
            n=tuple(map(int, grid["n"])),
            phi=phi,
            kt=tuple(map(float, grid["kt"])) if config["effects"]["friction"] else (0.0,),
            seeds=int(grid["seeds"]),
            block=int(grid["block"]),
            law=ContactLaw(**config["contact_law"]),
            rigidity=observables["rigidity"],
            step_strain=observables["step_strain"],
            spectrum=observables["spectrum"],
            spectrum_phi=spectrum_phi if observables["spectrum"] != "none" else (),
            protocol=Protocol(
                Compression(**protocol["compression"]),
                StepStrain(**protocol["step_strain"]),
                Rattlers(**protocol["rattlers"]),
            ),
            figures=tuple(config["figures"] if "figures" in config else drawable(config)),
        )

    @property
    def blocks(self) -> list[str]:
        """Names of the blocks of seeds."""
        return seed_blocks(self.seeds, self.block)

    def law_at(self, kt: float) -> ContactLaw:
        """The contact law with this tangential stiffness."""
        return replace(self.law, kt=kt)

    def responses(self, phi: float) -> list[str]:
        """Stages that a point at this area fraction asks for, beside its packings.

        An area fraction off the grid gets what the observables ask for everywhere.
        """
        spectrum = self.spectrum != "none" and (phi in self.spectrum_phi or phi not in self.phi)
        wanted = {
            "rigidity": self.rigidity,
            "step_strain": self.step_strain,
            "spectrum": spectrum,
        }
        return [stage for stage, asked in wanted.items() if asked]

    def settings(self, stage: str) -> str:
        """The part of the scene that a stage depends on, as JSON: the argument of its command.

        Everything a stage ignores stays out, so that changing it does not make the stage again.
        """
        law = {key: value for key, value in asdict(self.law).items() if key != "kt"}
        protocol = asdict(self.protocol)
        parts = {
            "compress": _part({"normal": self.law.normal}, protocol, "compression"),
            "rigidity": _part(law, protocol, "rattlers"),
            "step_strain": _part(law, protocol, "step_strain"),
            "spectrum": _part(law, protocol, "rattlers")
            | {"observables": {"spectrum": self.spectrum}},
            "ensemble": _part(law, protocol, *protocol) | {"study": self.study},
        }
        return json.dumps(parts[stage], sort_keys=True)


def _part(law: dict, protocol: dict, *names: str) -> dict:
    return {"contact_law": law, "protocol": {name: protocol[name] for name in names}}


def drawable(config: dict) -> list[str]:
    """Names of the figures that a complete configuration allows."""
    return [name for name in FIGURES if not lacking(name, config)]


def lacking(figure: str, config: dict) -> list[str]:
    """What a figure needs and a complete configuration does not ask for."""
    observables = config["observables"]
    asked = {
        "rigidity": observables["rigidity"],
        "spectrum": observables["spectrum"] != "none",
        "modes": observables["spectrum"] == "modes",
        "friction": config["effects"]["friction"] and any(map(bool, config["grid"]["kt"])),
    }
    return [name for name in FIGURES[figure].observables if not asked.get(name)]
