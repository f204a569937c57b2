"""One packing sheared under several tangential laws: C, Sec. VIII, "How generic …".

Every law starts from the same frictionless balance, s = 0, and goes its own way of quasistatic
steps Δγ (`strain_step`). On the way complex pairs of M⁻¹J are counted, on both sides of Coulomb's
threshold (`coulomb_threshold`), and every state with a pair is released (`simulated_growth`).

What may make J asymmetric, and so pairs possible:

| term                               | elastic | elastic force | smoothed | sharp    | sharp force |
| ---------------------------------- | ------- | ------------- | -------- | -------- | ----------- |
| −(f_T/r) n tᵀ: the tangent turns   | yes     | yes           | yes      | yes      | yes         |
| ∂f_T/∂ξ of a spring that sticks    | Hertz   | no            | yes      | Hertz    | no          |
| ∂f_T/∂ξ = ∓μ f_N' where it slips   | no      | no            | yes      | one side | one side    |
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.packing.state import Packing
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.release.simulated_growth import simulated_growth_rate
from grainmodes.protocols.shear.coulomb_threshold import (
    SLIPPING,
    STICKING,
    fastest_pair,
    slipping_contacts,
)
from grainmodes.protocols.shear.strain_step import first_equilibrium, step_to
from grainmodes.relaxation.equilibrium_state import EquilibriumState

STATES = 20
"""States along the way at which pairs are counted."""


class Seen(NamedTuple):
    """A state on the way.

    `rate` is the largest ω_i where springs at their threshold slip, 0 without pairs; `growth` the
    rate at which the released state leaves, NaN without pairs; `slipping` the number of contacts at
    their threshold.
    """

    strain: float
    pairs_slipping: int
    pairs_sticking: int
    slipping: int
    rate: float
    growth: float

    @classmethod
    def of(cls, equilibrium: EquilibriumState) -> Seen:
        """Count the pairs of a state, and release it where there is one."""
        packing, interaction = equilibrium.backbone, equilibrium.interaction
        slips, sticks = (fastest_pair(packing, interaction, s) for s in (SLIPPING, STICKING))
        slipping = int(slipping_contacts(packing.contacts, interaction).sum())
        growth = simulated_growth_rate(packing, interaction, slips) if slips.pairs else np.nan
        return cls(packing.strain, slips.pairs, sticks.pairs, slipping, slips.growth_rate, growth)


@dataclass
class Variant:
    """What was seen under one law; `ending` says why it ended before the last strain, if it did."""

    seen: list[Seen] = field(default_factory=list)
    ending: str = ""


def variant(packing: Packing, interaction: Interaction, choices: Shear) -> Variant:
    """A packing sheared to `choices.strain` under one law, as far as balances are found."""
    found, steps = Variant(), round(choices.strain / choices.step)
    every = max(1, steps // STATES)
    try:
        equilibrium = first_equilibrium(packing, interaction, choices)
        for step in range(1, steps + 1):
            equilibrium, _ = step_to(step * choices.step, equilibrium, choices)
            if step % every == 0:
                found.seen.append(Seen.of(equilibrium))
    except ArithmeticError as error:
        found.ending = str(error)
    return found
