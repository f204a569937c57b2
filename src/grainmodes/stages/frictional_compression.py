"""The stages `compress_with_friction` and `equilibrate_with_friction`: B's packings.

    random grains → checkpoint → checkpoint → … → packing

as without friction (`stages.compression`), but for one k_T and one tangential law: friction acts
from the beginning. The rows hold the springs of the contacts.
"""

from __future__ import annotations

from dataclasses import asdict

from grainmodes.dataset.files import Block
from grainmodes.parameters.compression import Compression, FrictionalCompression
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression.frictional_trajectory import (
    FrictionalPress,
    compress_along_grid,
    compress_to,
)
from grainmodes.protocols.compression.trajectory import place_at_random
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block, stage_attributes
from grainmodes.stages.trajectory_rows import (
    check_samples,
    check_start,
    trajectory_in_row,
    trajectory_row,
)


def frictional_compress_block(
    n: int,
    seeds: range,
    phi: float,
    law: ContactLaw,
    compression: Compression,
    choices: FrictionalCompression,
    start: Block | None,
) -> Block:
    """Trajectories at the checkpoint φ, from random placement or from the checkpoint `start`."""
    press = FrictionalPress(law, compression, choices)
    normal, config = press.interaction.normal, _config(press)
    if start is not None:
        check_start(start, config, phi)
        check_samples(start, n, seeds)

    def sample(number: int) -> dict[str, object]:
        before = (
            place_at_random(n, seeds[number], normal, compression)
            if start is None
            else trajectory_in_row(start, number)
        )
        return trajectory_row(compress_along_grid(before, phi, press))

    attributes = stage_attributes("trajectories", config, n=n, phi=phi, kt=law.kt)
    return compute_block(seeds, sample, attributes, start)


def frictional_packing_block(
    start: Block,
    phi: float,
    law: ContactLaw,
    compression: Compression,
    choices: FrictionalCompression,
) -> Block:
    """Packings at φ in their final balance, each on a branch from its checkpoint."""
    press = FrictionalPress(law, compression, choices)
    interaction, config = press.interaction, _config(press)
    check_start(start, config, phi)

    def sample(number: int) -> dict[str, object]:
        grid = compress_along_grid(trajectory_in_row(start, number), phi, press)
        relaxed = compress_to(grid, phi, press)
        return packing_row(relaxed.packing, *interaction) | {
            "phi_jamming": grid.phi_jamming,
            "converged": True,
            "iterations": relaxed.iterations,
        }

    n = int(start.attributes["n"])
    attributes = stage_attributes("packings", config, n=n, phi=phi, kt=law.kt)
    return compute_block(start.variables["seed"], sample, attributes, start)


def _config(press: FrictionalPress) -> dict[str, object]:
    return {
        "law": asdict(press.law),
        "compression": asdict(press.compression),
        "frictional_compression": asdict(press.choices),
    }
