"""The stage `complex_pairs`: the complex pairs of every packing of a block along its shear: C, V.

A row holds every state in numbers, every pair from its birth to its death, the exceptional points
that were located with the states near them, the two modes of each along the shear, and the full
states from which the dynamics is released (C, Sec. VI), as `protocol.complex_pairs.release_rates`
chooses them.
"""

from __future__ import annotations

from dataclasses import asdict

from grainmodes.dataset.files import Block
from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.parameters.complex_pairs import PairChoices
from grainmodes.parameters.law import ContactLaw
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.pair_tracking.tracking import PairTracking
from grainmodes.stages.complex_pair_rows import tracking_row
from grainmodes.stages.rows import loss, response_block
from grainmodes.stages.samples import jammed_packing

UNUSED_SHEAR_CHOICES = ("min_step", "lowest_eigenvalue")
"""Choices of a shear that have no effect on this stage."""


def complex_pairs_block(
    packings: Block, law: ContactLaw, shear: Shear, choices: PairChoices
) -> Block:
    """The complex pairs of every packing up to the last strain of `shear`.

    A sample that ends before its last strain keeps what it has, and is not converged.
    """
    interaction = Interaction.from_law(law)

    def sample(number: int) -> dict[str, object]:
        packing, jammed = jammed_packing(packings, number, interaction)
        if not jammed:
            row: dict[str, object] = {"pair_state_count": 0, "unstable_found": [False]}
            return row | {"jammed": False, "converged": True}
        tracking = PairTracking.start(packing, interaction, shear, choices)
        try:
            while not tracking.done:
                tracking.advance()
        except NUMERICAL_ERRORS as error:
            return tracking_row(tracking) | loss({"": error})
        return tracking_row(tracking)

    used = {
        name: value for name, value in asdict(shear).items() if name not in UNUSED_SHEAR_CHOICES
    }
    config = {"law": asdict(law), "shear": used, "complex_pairs": asdict(choices)}
    return response_block(packings, "complex_pairs", config, law, sample)
