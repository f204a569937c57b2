"""The states around an event, and what the grains do there: B, Figs. 3 to 6 and 13.

The event lies between γ_c− and γ_c+ = γ_c− + Δγ_Th. The states are taken at

    γ_c+ − δ and γ_c− + δ,    δ = Δγ_Th, 10 Δγ_Th, …, Δγ_in

so that their true distance from the event is between δ − Δγ_Th and δ. Those after the event are
reached onwards from γ_c+, those before it backwards from γ_c−, on the branch that ends there.

    σ' = ±(σ(γ ± h) − σ(γ))/h    away from the event                                    B (17)
    dq̊/dγ at γ_c+, by one solve with J and as (q̊(γ_c+ + Δγ) − q̊(γ_c+))/Δγ        B (13), (14), (41)
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.packing.state import nan_on_rattlers, nonaffine_motion
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.events import count_network_changes
from grainmodes.protocols.shear.first_event import Bracket
from grainmodes.protocols.shear.sheared_state import ShearedState
from grainmodes.protocols.shear.strain_step import step_to
from grainmodes.response.stability import LowestMode, lowest_mode

SLOPE_STEP = 1e-7
"""h: the error of the slope is g' h / 2 ~ 1e-7 k_N, its noise F_Th / h."""

RATE_STEP = 1e-8
"""Δγ of the simulated dq̊/dγ, as in B, Fig. 5."""


class BranchState(NamedTuple):
    """A state on one of the two branches that meet at an event.

    `distance` is δ, negative before the event, and `slope` σ' in k_N d^(1/2). `changes` is the
    number of contacts that differ from those of the state at this end of the bracket.
    """

    distance: float
    state: ShearedState
    slope: float
    changes: int


def states_around(bracket: Bracket, choices: Shear) -> list[BranchState]:
    """The states on both branches, γ ascending; none without an event.

    A branch ends where there is no equilibrium.
    """
    low, high = bracket.before, bracket.after
    if high is None:
        return []
    distances = branch_distances(choices)
    before = _states_on_branch(low, [-d for d in distances], high.strain, choices)
    after = _states_on_branch(high, distances, low.strain, choices)
    return before[::-1] + after


def branch_distances(choices: Shear) -> list[float]:
    """δ, ascending."""
    count = round(np.log10(choices.step / choices.min_step))
    return [choices.step / 10**k for k in range(count, -1, -1)]


def _states_on_branch(
    end: ShearedState, distances: list[float], origin: float, choices: Shear
) -> list[BranchState]:
    """The states at `origin` plus each distance, from the end of the branch outwards."""
    found, state = [], end
    for number, distance in enumerate(distances):
        try:
            if number:
                state = _state_at(origin + distance, state, choices)
            size = np.copysign(SLOPE_STEP, distance)
            slope = (_state_at(state.strain + size, state, choices).sigma - state.sigma) / size
        except NUMERICAL_ERRORS:
            break
        changes = sum(count_network_changes(end.equilibrium, state.equilibrium))
        found.append(BranchState(distance, state, slope, changes))
    return found


def _state_at(strain: float, before: ShearedState, choices: Shear) -> ShearedState:
    equilibrium, jumped = step_to(strain, before.equilibrium, choices)
    units = round(strain / choices.min_step)
    return ShearedState(equilibrium, units, choices.loaded, jumped)


def lowest_mode_of(state: ShearedState) -> tuple[LowestMode, np.ndarray]:
    """The lowest mode of J, and its eigenvector on all grains, (N, 3), NaN on rattlers."""
    equilibrium = state.equilibrium
    mode = lowest_mode(equilibrium.matrix, equilibrium.factor, equilibrium.force.shape[1])
    vector = mode.vector.reshape(len(equilibrium.force), -1)
    return mode, nan_on_rattlers(vector, equilibrium.backbone_mask)


def nonaffine_rate(state: ShearedState) -> np.ndarray:
    """dq̊/dγ by linear response, (N, 3) in d, NaN on rattlers: B (41)."""
    return nan_on_rattlers(state.response.displacement, state.equilibrium.backbone_mask)


def simulated_nonaffine_rate(state: ShearedState, choices: Shear) -> np.ndarray:
    """dq̊/dγ by a step of `RATE_STEP`, (N, 3) in d, NaN on rattlers: B (13), (14).

    Raises:
        ArithmeticError: no equilibrium was found after the step.
    """
    after = _state_at(state.strain + RATE_STEP, state, choices)
    backbone_mask = state.equilibrium.backbone_mask
    motion = (
        nonaffine_motion(state.equilibrium.packing, after.equilibrium.packing)[backbone_mask]
        / RATE_STEP
    )
    motion[:, :2] -= motion[:, :2].mean(axis=0)
    return nan_on_rattlers(motion, backbone_mask)
