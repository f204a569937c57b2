"""The stages `compress` and `equilibrate`: from grains at random to packings in force balance.

    random grains → checkpoint → checkpoint → … → packing

A trajectory runs through checkpoints in steps of φ; a packing branches off from the checkpoint
below it.
"""

from __future__ import annotations

from dataclasses import asdict

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.parameters.compression import Compression
from grainmodes.parameters.law import ContactLaw
from grainmodes.protocols.compression.trajectory import (
    compress_along_grid,
    compress_to,
    place_at_random,
)
from grainmodes.stages.rows import block_of, described
from grainmodes.stages.samples import (
    check_same,
    check_start,
    checkpoint,
    packed,
    trajectory_of,
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
    law = _normal(normal)
    config = {"compression": asdict(compression), "normal": normal}
    if start is not None:
        check_start(start, config, phi)
        check_same(start, n, seeds)

    def sample(number: int) -> dict[str, object]:
        before = (
            place_at_random(n, seeds[number], law, compression)
            if start is None
            else trajectory_of(start, number)
        )
        return checkpoint(compress_along_grid(before, phi, law, compression))

    attributes = described("trajectories", config, n=n, phi=phi)
    failures = {} if start is None else start.mapping("failures")
    return block_of(seeds, sample, failures, attributes)


def packing_block(start: Block, phi: float, compression: Compression, normal: str) -> Block:
    """Packings at φ in their final balance, each on a branch from its checkpoint."""
    law = _normal(normal)
    config = {"compression": asdict(compression), "normal": normal}
    check_start(start, config, phi)

    def sample(number: int) -> dict[str, object]:
        grid = compress_along_grid(trajectory_of(start, number), phi, law, compression)
        relaxed = compress_to(grid, phi, law, compression)
        if not relaxed.converged:
            raise ArithmeticError(
                f"max|F| = {relaxed.max_force:.1e} after {relaxed.iterations} iterations"
            )
        return packed(relaxed.packing, law) | {
            "phi_jamming": grid.phi_jamming,
            "converged": True,
            "iterations": relaxed.iterations,
        }

    attributes = described("packings", config, n=int(start.attributes["n"]), phi=phi)
    failures = start.mapping("failures")
    return block_of(start.variables["seed"], sample, failures, attributes)


def _normal(name: str):
    return Interaction.from_law(ContactLaw(normal=name)).normal
