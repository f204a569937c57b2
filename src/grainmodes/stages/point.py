"""One point of the grid from nothing to its numbers, in memory: what a study does in files."""

from __future__ import annotations

from grainmodes.dataset.files import Block
from grainmodes.ensemble.point import merge_blocks
from grainmodes.parameters.grid import checkpoints_up_to
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.protocol import Protocol
from grainmodes.stages import packings as stages
from grainmodes.stages.spectrum import spectrum_block


def point_block(
    n: int, phi: float, law: ContactLaw, seeds: range, protocol: Protocol, spectrum: str
) -> Block:
    """Every observable of the point (n, φ, k_T) for some seeds.

    The packings go through the same checkpoints as in a study, so the numbers are the same.
    `spectrum` is one of `parameters.spectra.SPECTRA`.
    """
    start = None
    for checkpoint in checkpoints_up_to(phi):
        start = stages.compress_block(n, seeds, checkpoint, protocol.compression, law.normal, start)
    packings = stages.packing_block(start, phi, protocol.compression, law.normal)
    parts = {
        "packings": packings,
        "rigidity": stages.rigidity_block(packings, law, protocol.rattlers),
        "step_strain": stages.step_strain_block(packings, law, protocol.step_strain),
    }
    if spectrum != "none":
        parts["spectrum"] = spectrum_block(
            packings, law, protocol.rattlers, spectrum, protocol.spectrum
        )
    return merge_blocks(parts)
