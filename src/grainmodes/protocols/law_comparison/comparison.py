"""One packing sheared under several tangential laws: C, Sec. VIII, "How generic …".

Under every law the shear starts from the same frictionless equilibrium, s = 0, in quasistatic steps
Δγ (`strain_step`). Along it complex pairs of M⁻¹J are counted on both sides of Coulomb's threshold
(`coulomb_threshold`), and every state with a pair is released (`simulated_growth`).

These terms make J asymmetric, and so pairs possible:

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
from grainmodes.linalg.failures import NUMERICAL_ERRORS
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

N_STATES = 20
"""States of a shear in which pairs are counted."""


class ComparedState(NamedTuple):
    """One state of a shear under one law.

    Attributes:
        strain: γ.
        pairs_slipping: complex pairs of M⁻¹J where springs at their threshold slip.
        pairs_sticking: complex pairs where they stick.
        slipping: number of contacts at their threshold.
        rate: largest ω_i where they slip, in 1/t_0; 0 without pairs.
        growth: rate at which the released state is left, in 1/t_0; NaN without pairs.
    """

    strain: float
    pairs_slipping: int
    pairs_sticking: int
    slipping: int
    rate: float
    growth: float


@dataclass
class LawRun:
    """The states of a shear under one law; `failure` is why it ended early, if it did."""

    states: list[ComparedState] = field(default_factory=list)
    failure: Exception | None = None


def shear_under_law(packing: Packing, interaction: Interaction, choices: Shear) -> LawRun:
    """Shear a packing to `choices.strain` under one law, as far as equilibria are found."""
    run, steps = LawRun(), round(choices.strain / choices.step)
    interval = max(1, steps // N_STATES)
    try:
        equilibrium = first_equilibrium(packing, interaction, choices)
        for step in range(1, steps + 1):
            equilibrium, _ = step_to(step * choices.step, equilibrium, choices)
            if step % interval == 0:
                run.states.append(compare_state(equilibrium))
    except NUMERICAL_ERRORS as error:
        run.failure = error
    return run


def compare_state(equilibrium: EquilibriumState) -> ComparedState:
    """Count the pairs of a state on both sides of the threshold, and release it if there is one.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    packing, interaction = equilibrium.backbone, equilibrium.interaction
    slips, sticks = (fastest_pair(packing, interaction, side) for side in (SLIPPING, STICKING))
    slipping = int(slipping_contacts(packing.contacts, interaction).sum())
    growth = simulated_growth_rate(packing, interaction, slips) if slips.pairs else np.nan
    return ComparedState(
        packing.strain, slips.pairs, sticks.pairs, slipping, slips.growth_rate, growth
    )
