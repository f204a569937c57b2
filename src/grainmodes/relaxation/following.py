"""A force balance found from a state near it, contacts opening and closing on the way.

    q → q + J⁻¹ F̃        F̃ of the grains that carry load, until max|F̃| < tolerance

With the factors of the balance it comes from, a step between events takes three solutions and no
factorisation. Where they do not gain a decade (a contact has opened or closed, or the forces bend),
J is factored anew and the step shortened until max|F̃| falls. Each iterate is judged on its own
contact network; grains that lose their hold on the way are left out, and those that are touched
come back in. The balance may be a saddle: `Balance.unstable` tells.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.linear import FloppyError, PinnedFactor
from grainmodes.packing import Packing
from grainmodes.relaxation.balance import GAIN, Balance, Inherited
from grainmodes.relaxation.rattlers import moved_out

MOST = 40
"""Iterations: ten times what a step between events needs."""

FARTHEST = 1.0
"""Motion of a grain, in d, at which a Newton step is not even tried: J is next to singular."""

SHORTEST_STEP = 0.1
"""Fraction of a Newton step below which it is given up."""


def find_balance(
    packing: Packing,
    interaction: Interaction,
    tolerance: float,
    before: Balance | None = None,
    like: PinnedFactor | None = None,
    most_lost: float = np.inf,
) -> Balance | None:
    """The balance near a state, max|F̃| < `tolerance`; None where the iteration does not lead there.

    Args:
        before: the balance it comes from, whose factors are used as long as they do.
        like: factors whose order of elimination may do, where there is no `before`.
        most_lost: force on a contact that opens at which the search is given up.
    """
    inherited = before and before.handed_on
    factor = inherited and inherited.factor
    now = Balance.of(packing, interaction, factor or like)
    if before and not np.array_equal(before.held, now.held):
        inherited = None
    for _ in range(MOST):
        if now is None or now.lost > most_lost:
            return None
        if now.residual < tolerance:
            settled = _let_go(now)
            if settled is now:
                return now.heir(inherited)
            now, inherited = settled, None
        else:
            now, inherited = _step(now, inherited, tolerance)
    return None


def _step(
    now: Balance, inherited: Inherited | None, tolerance: float
) -> tuple[Balance | None, Inherited | None]:
    """The next iterate, and the factors that led there if they gained a decade."""
    if not now.held.any():
        return None, None
    if inherited is not None:
        u = _displacement(now, inherited.factor)
        after = now.moved(u) if np.abs(u).max() < FARTHEST else now
        if _gained(now, after, tolerance):
            return after, inherited
    try:
        u = _displacement(now, now.factor)
    except FloppyError:
        return None, None
    length = 1.0 if np.abs(u).max() < FARTHEST else 0.0
    while length >= SHORTEST_STEP:
        after = now.moved(length * u)
        if after.residual < now.residual:
            return after, Inherited(now.factor, 1) if _gained(now, after, tolerance) else None
        length *= 0.5
    return None, None


def _gained(now: Balance, after: Balance, tolerance: float) -> bool:
    """Whether a step brought a decade between the same grains, by factors worth keeping."""
    decade = after.residual < max(GAIN * now.residual, tolerance)
    return decade and np.array_equal(now.held, after.held)


def _displacement(now: Balance, factor: PinnedFactor) -> np.ndarray:
    return factor.solve(now.force, refined=False).reshape(now.force.shape)


def _let_go(balance: Balance) -> Balance:
    """The same if no loose grain touches anything, else the state with them moved out."""
    loose = ~balance.held
    if not np.any(loose[balance.contacts.i] | loose[balance.contacts.j]):
        return balance
    packing = moved_out(balance.packing, balance.interaction.normal, loose)
    settled = Balance.of(packing, balance.interaction, balance.like)
    return replace(settled, lost=balance.lost)
