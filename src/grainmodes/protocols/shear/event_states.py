"""The states around an event, and what the grains do in it: B, Figs. 3 to 6 and 13.

With the event between γ_c− and γ_c+ = γ_c− + Δγ_Th, the states lie at

    γ_c+ − δ and γ_c− + δ,    δ = Δγ_Th, 10 Δγ_Th, …, Δγ_in

so that their true distance from the event is between δ − Δγ_Th and δ. Those after it are reached
onwards from γ_c+; those before it backwards from γ_c−, on the branch that the event ends.

    σ' = ±(σ(γ ± h) − σ(γ))/h    away from the event                                    B (17)
    dq̊/dγ at γ_c+, by one solve with J and as (q̊(γ_c+ + Δγ) − q̊(γ_c+))/Δγ        B (13), (14), (41)
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.packing.state import nonaffine_motion
from grainmodes.parameters.strain import Shear
from grainmodes.protocols.shear.first_event import Bracket
from grainmodes.protocols.shear.quasistatic import step_to
from grainmodes.protocols.shear.state import State, network_changes
from grainmodes.response.stability import LowestMode, lowest_mode

SLOPE_STEP = 1e-7
"""h: the slope is right to g' h / 2 ~ 1e-7 k_N, its noise F_Th / h."""

RATE_STEP = 1e-8
"""Δγ of the simulated dq̊/dγ, as in B, Fig. 5."""


class Near(NamedTuple):
    """A state near an event; `distance` is δ, below 0 before the event.

    `changes`: contacts that differ from those of the state at this end of the bracket.
    """

    distance: float
    state: State
    slope: float
    changes: int


def states_around(bracket: Bracket, choices: Shear) -> list[Near]:
    """Lowest eigenvalues, g and slopes on both branches, γ ascending; a branch may end early."""
    low, high = bracket.before, bracket.after
    distances = distances_of(choices)
    before = _branch(low, [-d for d in distances], high.strain, choices)
    after = _branch(high, distances, low.strain, choices)
    return before[::-1] + after


def distances_of(choices: Shear) -> list[float]:
    """δ, ascending."""
    count = round(np.log10(choices.step / choices.min_step))
    return [choices.step / 10**k for k in range(count, -1, -1)]


def _branch(end: State, distances: list[float], origin: float, choices: Shear) -> list[Near]:
    """The states at `origin` + each distance, from the end of a branch outwards."""
    found, now = [], end
    for number, distance in enumerate(distances):
        try:
            if number:
                now = _at(origin + distance, now, choices)
            size = np.copysign(SLOPE_STEP, distance)
            slope = (_at(now.strain + size, now, choices).sigma - now.sigma) / size
        except ArithmeticError:
            break
        changes = sum(network_changes(end.balance, now.balance))
        found.append(Near(distance, now, slope, changes))
    return found


def _at(strain: float, before: State, choices: Shear) -> State:
    balance, jumped = step_to(strain, before.balance, choices)
    units = round(strain / choices.min_step)
    return State(balance, units, choices.loaded, jumped)


def lowest_mode_of(state: State) -> tuple[LowestMode, np.ndarray]:
    """The lowest mode of a state, and its eigenvector on all grains, (N, 3)."""
    balance = state.balance
    mode = lowest_mode(balance.matrix, balance.factor, balance.force.shape[1])
    return mode, on_all(mode.vector.reshape(len(balance.force), -1), balance.held)


def rate_of(state: State) -> np.ndarray:
    """dq̊/dγ by linear response, (N, 3) in d: B (41)."""
    return on_all(state.response.displacement, state.balance.held)


def simulated_rate(state: State, choices: Shear) -> np.ndarray:
    """dq̊/dγ by a step of `RATE_STEP`, (N, 3) in d: B (13), (14).

    Raises:
        ArithmeticError: no balance was found there.
    """
    after = _at(state.strain + RATE_STEP, state, choices)
    held = state.balance.held
    moved = nonaffine_motion(state.balance.packing, after.balance.packing)[held] / RATE_STEP
    moved[:, :2] -= moved[:, :2].mean(axis=0)
    return on_all(moved, held)


def on_all(field: np.ndarray, held: np.ndarray) -> np.ndarray:
    """A field (N', k) of the grains that carry load on all grains, (N, 3); else NaN."""
    whole = np.full((len(held), 3), np.nan)
    whole[held, : field.shape[1]] = field
    return whole
