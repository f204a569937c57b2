"""The table of measured costs, and its growth laws.

| symbol | name              | meaning                                       |
| ------ | ----------------- | --------------------------------------------- |
| c      | `seconds`         | CPU seconds of one unit of work at N = 1024   |
| p      | `exponent`        | its growth, c (N / 1024)^p                    |
|        | `megabytes`       | memory above that of a bare job at N = 1024   |
|        | `memory_exponent` | its growth                                    |
|        | `up_to`           | largest N measured; 0 for a guess             |
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import yaml

from grainmodes.parameters.compression import Compression

COSTS = Path(__file__).with_name("costs.yaml")
"""The table that comes with the package."""

REFERENCE = 1024
"""N at which costs are given."""


@dataclass(frozen=True)
class GrowthLaw:
    """The cost of one unit of work as a power of N."""

    seconds: float
    exponent: float
    megabytes: float
    memory_exponent: float
    up_to: int

    def seconds_at(self, n: int) -> float:
        """CPU seconds of one thread."""
        return self.seconds * (n / REFERENCE) ** self.exponent

    def megabytes_at(self, n: int) -> float:
        """Memory above that of a job that does nothing, in MB."""
        return self.megabytes * (n / REFERENCE) ** self.memory_exponent


UNMEASURED = GrowthLaw(1.0, 1.0, 100.0, 1.0, up_to=0)
"""What a stage is taken to cost before `snakemake growth` has measured it."""


@dataclass(frozen=True)
class Table:
    """Everything in `costs.yaml`."""

    machine: str
    laws: dict[str, GrowthLaw]
    climb: dict[float, float]
    frictional_climb: dict[float, float]
    compression: dict[str, float]
    job: dict[str, float]
    compilation: dict[str, float]
    gathering: dict[str, float]
    disk: dict[str, float]

    def growth_law(self, name: str) -> GrowthLaw:
        """The growth law of a stage or of a kind of work; a guess where it was never measured."""
        return self.laws.get(name, UNMEASURED)

    def share(self, phi: float, with_friction: bool = False) -> float:
        """Part of a trajectory to φ = 0.90 that lies below φ, linear between rows of `climb`."""
        climb = self.frictional_climb if with_friction else self.climb
        pairs = list(pairwise(sorted(climb.items())))
        (low, start), (high, stop) = next((p for p in pairs if phi <= p[1][0]), pairs[-1])
        return start + (stop - start) * (phi - low) / (high - low)

    def slowdown(
        self, compression: Compression, with_friction: bool = False, kt: float = 0.0
    ) -> float:
        """Factor on the time of a trajectory for other choices than the default ones.

        Above k_T = k_N the time step of the compression with friction is shorter.
        """
        steps = compression.phi_step / self.compression["phi_step"]
        if with_friction:
            shorter = math.sqrt(max(1.0, kt))
            return shorter * steps ** self.compression["frictional_step_exponent"]
        return self.compression[compression.relaxation] * steps ** self.compression["step_exponent"]


def read_table(path: str | Path = COSTS) -> Table:
    """The table of a file.

    Raises:
        ValueError: the file is not such a table.
        OSError: it cannot be read.
    """
    try:
        content = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
        laws = {name: GrowthLaw(**row) for name, row in content["laws"].items()}
        return Table(**content | {"laws": laws})
    except KeyError as error:
        raise ValueError(
            f"{path}: expected a table of costs such as {COSTS}, got a file without the key {error}"
        ) from error
    except (yaml.YAMLError, TypeError, AttributeError) as error:
        reason = " ".join(str(error).split())
        raise ValueError(
            f"{path}: expected a table of costs such as {COSTS}, got another file ({reason})"
        ) from error
