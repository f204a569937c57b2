"""The stage `fields`: what grains do, grain by grain, in one sample.

A study averages numbers over samples and keeps no grain; these few files keep every grain of one
sample, to be drawn.
"""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.fields import MOST_FOR_ALL_MODES, field_frequencies
from grainmodes.parameters.law import ContactLaw, Rattlers
from grainmodes.parameters.strain import StepStrain
from grainmodes.protocols.shear.step_strain_field import simulated_field
from grainmodes.response.fields import affine_field, mode_sum_field, nearest_modes, nonaffine_field
from grainmodes.stages.rows import response_block
from grainmodes.stages.samples import first_sample, jammed_packing, springs_at_rest


def fields_block(
    packings: Block,
    law: ContactLaw,
    rattlers: Rattlers,
    step: StepStrain,
) -> Block:
    """The fields of the first sample of a block, and its modes nearest to A's frequencies."""
    interaction, threshold = (
        Interaction.from_law(law),
        rattlers.largest(law, springs_at_rest(packings)),
    )

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        row = _grains(packing) | {"jammed": jammed, "converged": True}
        if not jammed:
            return row
        row["nonaffine_field"] = nonaffine_field(packing, interaction, threshold)
        row["nonaffine_field_simulated"] = simulated_field(packing, interaction, step, threshold)
        if packing.n <= MOST_FOR_ALL_MODES:
            row["nonaffine_field_mode_sum"] = mode_sum_field(packing, interaction, threshold)
        return row | _modes(packing, interaction, field_frequencies(law.kt), threshold)

    config = {"law": asdict(law), "rattlers": asdict(rattlers), "step_strain": asdict(step)}
    return response_block(first_sample(packings), "fields", config, law, sample)


def _grains(packing: Packing) -> dict[str, object]:
    return {
        "position": packing.position,
        "diameter": packing.diameter,
        "box_length": packing.box_length,
        "strain": packing.strain,
        "affine_field": affine_field(packing),
    }


def _modes(
    packing: Packing, interaction: Interaction, frequencies: tuple[float, ...], threshold: int
) -> dict[str, object]:
    found = nearest_modes(packing, interaction, frequencies, threshold)
    return {
        "frequency_requested": np.array(frequencies),
        "frequency_found": found.frequency,
        "eigenvector": found.eigenvector,
        "residual": found.residual.max(),
    }
