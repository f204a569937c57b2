"""All numerical choices of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.compression import Compression, FrictionalCompression
from grainmodes.parameters.law import Rattlers
from grainmodes.parameters.release import Release
from grainmodes.parameters.spectra import SpectrumChoices
from grainmodes.parameters.strain import Shear, StepStrain


@dataclass(frozen=True)
class Protocol:
    """Every numerical choice of a study, with its default."""

    compression: Compression = field(default_factory=Compression)
    frictional_compression: FrictionalCompression = field(default_factory=FrictionalCompression)
    step_strain: StepStrain = field(default_factory=StepStrain)
    shear: Shear = field(default_factory=Shear)
    complex_pairs: PairChoices = field(default_factory=PairChoices)
    release: Release = field(default_factory=Release)
    rattlers: Rattlers = field(default_factory=Rattlers)
    spectrum: SpectrumChoices = field(default_factory=SpectrumChoices)

    @classmethod
    def from_config(cls, config: Mapping[str, Mapping]) -> Protocol:
        """The choices in the complete and valid block `protocol` of a configuration."""
        release, pairs = dict(config["release"]), dict(config["complex_pairs"])
        release["dampings"] = tuple(release["dampings"])
        pairs["release_rates"] = tuple(pairs["release_rates"])
        return cls(
            Compression(**config["compression"]),
            FrictionalCompression(**config["frictional_compression"]),
            StepStrain(**config["step_strain"]),
            Shear(**config["shear"]),
            PairChoices(**pairs),
            Release(**release),
            Rattlers(**config["rattlers"]),
            SpectrumChoices(**config["spectrum"]),
        )
