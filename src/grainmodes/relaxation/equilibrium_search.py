"""The force balance near a state, by Newton's method while contacts open and close on the way.

    q → q + J⁻¹ F̃        F̃ of the backbone, until max|F̃| < tolerance

With the factors of the state it comes from (`reused_factor`), a step between events takes three
solutions and no factorisation, also where contacts open or close. J is factored anew where these
factors do not reduce the residual to a tenth although the contacts have stayed the same. A step is
shortened until max|F̃| falls. Each iterate has its own contacts and its own backbone: grains that no
longer carry load leave it, and rattlers that are touched enter it. The balance that is found may be
a saddle point of the energy: see `EquilibriumState.unstable`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.pinned_factor import FloppyError
from grainmodes.packing.state import Packing
from grainmodes.relaxation.backtracking import backtrack
from grainmodes.relaxation.equilibrium_state import EquilibriumState
from grainmodes.relaxation.rattlers import detach_rattlers
from grainmodes.relaxation.reused_factor import MAX_RESIDUAL_RATIO, ReusedFactor

MAX_ITERATIONS = 40
"""Largest number of Newton steps: ten times what a step between events needs."""

MAX_NEWTON_STEP = 1.0
"""Displacement of a grain, in d, from which a Newton step is not tried: J is nearly singular."""


def find_equilibrium(
    packing: Packing,
    interaction: Interaction,
    tolerance: float,
    before: EquilibriumState | None = None,
    max_released_force: float = np.inf,
) -> EquilibriumState | None:
    """The state of force balance near a packing; None where the iteration does not reach one.

    Args:
        tolerance: max|F̃| of the balance, in k_N d^(3/2).
        before: the state that the packing comes from, whose factors are reused.
        max_released_force: the search ends where a contact opens that bears more, in k_N d^(3/2).

    Raises:
        PackingError: two grains lie at the same place.
        FloppyError: the backbone of `before` has zero modes beyond the translations.
    """
    start = EquilibriumState.from_packing(packing, interaction)
    state = start if before is None else start.with_factors_of(before)
    for _ in range(MAX_ITERATIONS):
        if state.released_force > max_released_force:
            return None
        if state.residual < tolerance:
            detached = _with_detached_rattlers(state)
            if detached is state:
                return state
            state = detached
            continue
        after = _newton_step(state, tolerance)
        if after is None:
            return None
        state = after
    return None


def _newton_step(state: EquilibriumState, tolerance: float) -> EquilibriumState | None:
    """The next iterate, with the factors that led to it as long as they are worth keeping."""
    if not state.backbone_mask.any():
        return None
    if state.low_rank_update is not None:
        u = state.low_rank_update.solve(state.force.ravel()).reshape(state.force.shape)
        after = _shortened_step(state, u)
        if after is not None and _factors_fit(state, after, tolerance):
            return after
    try:
        u = state.factor.solve(state.force, refined=False).reshape(state.force.shape)
    except FloppyError:
        return None
    fresh = replace(state, reused=ReusedFactor(state.base_factor, 1))
    after = _shortened_step(fresh, u)
    if after is not None and not _factors_fit(state, after, tolerance):
        return replace(after, reused=None)
    return after


def _shortened_step(state: EquilibriumState, u: NDArray[np.float64]) -> EquilibriumState | None:
    """The state after a Newton step u (N', k), halved until max|F̃| falls; None if it never does."""
    if not np.abs(u).max() < MAX_NEWTON_STEP:
        return None
    return backtrack(
        lambda fraction: state.displaced(fraction * u),
        lambda after: after.residual < state.residual,
    )


def _factors_fit(before: EquilibriumState, after: EquilibriumState, tolerance: float) -> bool:
    """Whether the factors that led from one state to the other are good enough for the next step.

    Where contacts have opened or closed, a large residual is not the fault of the factors.
    """
    small = after.residual < max(MAX_RESIDUAL_RATIO * before.residual, tolerance)
    return small or not np.array_equal(before.contact_keys, after.contact_keys)


def _with_detached_rattlers(state: EquilibriumState) -> EquilibriumState:
    """The state with its rattlers moved until they touch nothing; the same if none touches."""
    is_rattler, contacts = ~state.backbone_mask, state.packing.contacts
    if not np.any(is_rattler[contacts.i] | is_rattler[contacts.j]):
        return state
    packing = detach_rattlers(state.packing, state.interaction.normal, is_rattler)
    detached = EquilibriumState.from_packing(packing, state.interaction, state)
    # A grain that carries no load releases none when its contacts open.
    return replace(detached, released_force=state.released_force)
