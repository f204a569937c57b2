"""The stages `compress` and `equilibrate`: from grains at random to packings in force balance.

    random grains → checkpoint → checkpoint → … → packing

A trajectory runs through checkpoints in steps of φ; a packing branches off from the checkpoint
below it.
"""

from __future__ import annotations

from dataclasses import asdict

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction, NormalLaw
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.stages.packing_rows import packing_row
from grainmodes.stages.rows import compute_block, stage_attributes
from grainmodes.stages.trajectory_rows import (
    check_samples,
    check_start,
    trajectory_in_row,
    trajectory_row,
)


def compress_block(
    n: int,
    seeds: range,
    phi: float,
    compression: Compression,
    normal: str,
    start: Block | None,
) -> Block:
    """Trajectories at the checkpoint φ, from random placement or from the checkpoint `start`."""
    normal_law = _normal_law(normal)
    config = {"compression": asdict(compression), "normal": normal}
    if start is not None:
        check_start(start, config, phi)
        check_samples(start, n, seeds)

    def sample(number: int) -> dict[str, object]:
        before = (
            place_at_random(n, seeds[number], normal_law, compression)
            if start is None
            else trajectory_in_row(start, number)
        )
        return trajectory_row(compress_along_grid(before, phi, normal_law, compression))

    attributes = stage_attributes("trajectories", config, n=n, phi=phi)
    return compute_block(seeds, sample, attributes, start)


def packing_block(start: Block, phi: float, compression: Compression, normal: str) -> Block:
    """Packings at φ in their final balance, each on a branch from its checkpoint."""
    normal_law = _normal_law(normal)
    config = {"compression": asdict(compression), "normal": normal}
    check_start(start, config, phi)

    def sample(number: int) -> dict[str, object]:
        grid = compress_along_grid(trajectory_in_row(start, number), phi, normal_law, compression)
        relaxed = compress_to(grid, phi, normal_law, compression)
        if not relaxed.converged:
            raise ArithmeticError(
                f"balance at phi = {phi}: expected max|F| < {compression.force_tolerance:.1e}, got "
                f"{relaxed.max_force:.1e} after {relaxed.iterations} iterations"
            )
        return packing_row(relaxed.packing, normal_law) | {
            "phi_jamming": grid.phi_jamming,
            "converged": True,
            "iterations": relaxed.iterations,
        }

    attributes = stage_attributes("packings", config, n=int(start.attributes["n"]), phi=phi)
    return compute_block(start.variables["seed"], sample, attributes, start)


def _normal_law(name: str) -> NormalLaw:
    """The compiled normal law of a name."""
    return Interaction.from_law(ContactLaw(normal=name)).normal
