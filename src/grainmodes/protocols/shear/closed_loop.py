"""A closed loop of strain: do the springs come back? B, Sec. V, says that they have no history.

A shear in steps Δγ_in finds how far no contact opens, closes or lets go of its spring, looking at
`MAX_STEPS` steps at most. The loop goes half as far, and back to the first strain through the same
strains: next to a change even the step back, which begins with an affine one, may open the contact.
Without history every spring then is what it was, but for a part in proportion to Δγ_in, as a step
that does not load the springs by itself is a zigzag path:

    left = max|s − s_0| after the loop,   slide = max|s − s_0| at its largest strain
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import accepted_steps
from grainmodes.protocols.shear.quasistatic_run import QuasistaticRun
from grainmodes.protocols.shear.strain_step import step_to
from grainmodes.relaxation.equilibrium_state import EquilibriumState

MAX_STEPS = 20
"""Steps without a change that are looked for."""


class Loop(NamedTuple):
    """A closed loop; `slide` and `left` are in the unit of the springs, NaN without a step."""

    strain: float
    slide: float
    left: float


def closed_loop(packing: Packing, interaction: Interaction, choices: Shear) -> Loop:
    """The loop of a packing in balance.

    Raises:
        ArithmeticError: there is no stable equilibrium on the way.
    """
    whole_steps = replace(choices, min_step=choices.step)
    run = QuasistaticRun.from_packing(packing, interaction, whole_steps)
    quiet = [run.state.equilibrium]
    for _, after in accepted_steps(run):
        if run.network_changes or len(quiet) > MAX_STEPS:
            break
        quiet.append(after.equilibrium.without_factors())
    way = quiet[: len(quiet) // 2 + 1] if len(quiet) > 2 else quiet[:1]
    if len(way) == 1:
        return Loop(packing.strain, np.nan, np.nan)
    back = way[-1]
    for state in way[-2::-1]:
        back, _ = step_to(state.packing.strain, back, whole_steps)
    return Loop(way[-1].packing.strain, *(_largest_change(way[0], end) for end in (way[-1], back)))


def _largest_change(before: EquilibriumState, after: EquilibriumState) -> float:
    """max|Δs| over the contacts of both states between grains that carry load."""
    one, other = before.backbone.contacts, after.backbone.contacts
    _, here, there = np.intersect1d(one.key, other.key, assume_unique=True, return_indices=True)
    return float(np.abs(other.springs[there] - one.springs[here]).max(initial=0.0))
