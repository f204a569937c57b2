"""The samples in a block of packings: one of them, checked, or the block of the first alone."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from grainmodes.dataset.files import Block, BlockError
from grainmodes.dataset.lost import KINDS, of_samples
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.forces import max_force_and_torque, mean_contact_force, net_force
from grainmodes.packing.state import Packing
from grainmodes.parameters.compression import Compression
from grainmodes.stages.packing_rows import is_jammed, packing_in_row

MAX_FORCE_RATIO = 1e-6
"""Largest net force on a grain of a packing in balance, relative to the mean contact force."""


def jammed_packing(block: Block, number: int, interaction: Interaction) -> tuple[Packing, bool]:
    """The packing in a row, and whether it is jammed.

    Raises:
        ArithmeticError: its relaxation had not converged.
        PackingError: a stored value is NaN or infinite; the other samples may be sound.
        BlockError: it is not in force balance, although it should be.
    """
    if not block.variables["converged"][number]:
        raise ArithmeticError("the packing did not reach force balance")
    packing, always = packing_in_row(block, number), np.ones(number + 1)
    if packing.history is not None and not block.variables.get("jammed", always)[number]:
        return packing, False  # its grains creep, and are never in balance
    force = max(max_force_and_torque(net_force(packing, interaction)))
    mean = mean_contact_force(packing, interaction)
    limit = max(MAX_FORCE_RATIO * mean, force_tolerance(block))
    if not force <= limit:
        raise BlockError(
            f"packing of seed {seed_of(block, number)} is not in force balance: expected "
            f"max|F| <= {limit:.1e} at a mean contact force of {mean:.2e}, got {force:.2e}"
        )
    return packing, is_jammed(packing, interaction, force)


def springs_at_rest(packings: Block) -> bool:
    """Whether no spring of these packings is loaded, as after a compression without friction."""
    return "spring_state" not in packings.variables


def first_sample(block: Block) -> Block:
    """The block of its first sample alone."""
    seed = str(seed_of(block, 0))
    lost = {kind: of_samples(block.mapping(kind), [seed]) for kind in KINDS}
    rows = {name: array[:1] for name, array in block.variables.items()}
    return Block(rows, block.attributes | lost)


def seed_of(block: Block, number: int) -> int:
    """The seed of a row."""
    return int(block.variables["seed"][number])


def force_tolerance(block: Block) -> float:
    """F_Th that the packings of a block were made to; of foreign ones A's 1e-14."""
    compression = block.mapping("config").get("compression", asdict(Compression()))
    return float(compression["force_tolerance"])
