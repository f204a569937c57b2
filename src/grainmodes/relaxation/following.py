"""A force balance found from a state near it, contacts opening and closing on the way.

    q → q + J⁻¹ F̃        F̃ of the grains that carry load, until max|F̃| < tolerance

With the factors of the balance it comes from, a step between events takes three solutions and no
factorisation, contacts that open or close included. Where they do not gain a decade between the
same contacts, J is factored anew. A step is shortened until max|F̃| falls. Each iterate is judged on
its own contact network; grains that lose their hold on the way are left out, and those that are
touched come back in. The balance may be a saddle: `Balance.unstable` tells.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.pinned_factor import FloppyError
from grainmodes.packing.state import Packing
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
    most_lost: float = np.inf,
) -> Balance | None:
    """The balance near a state, max|F̃| < `tolerance`; None where the iteration does not lead there.

    Args:
        before: the balance it comes from, whose factors are used as long as they do.
        most_lost: force on a contact that opens at which the search is given up.
    """
    now = Balance.of(packing, interaction)
    if before is not None:
        now = now.heir_of(before)
    for _ in range(MOST):
        if now is None or now.lost > most_lost:
            return None
        if now.residual < tolerance:
            settled = _let_go(now)
            if settled is now:
                return now
            now = settled
        else:
            now = _step(now, tolerance)
    return None


def _step(now: Balance, tolerance: float) -> Balance | None:
    """The next iterate, with the factors that led there as long as they are worth keeping."""
    if not now.held.any():
        return None
    if now.fitted is not None:
        u = now.fitted.solve(now.force.ravel()).reshape(now.force.shape)
        after = _shortened(now, u)
        if after is not None and _worth(now, after, tolerance):
            return after
    try:
        u = now.factor.solve(now.force, refined=False).reshape(now.force.shape)
    except FloppyError:
        return None
    fresh = replace(now, inherited=Inherited(now.origin, 1))
    after = _shortened(fresh, u)
    if after is not None and not _worth(now, after, tolerance):
        return replace(after, inherited=None)
    return after


def _shortened(now: Balance, u: np.ndarray) -> Balance | None:
    """A Newton step, halved until max|F̃| falls; None if it hardly ever does."""
    length = 1.0 if np.abs(u).max() < FARTHEST else 0.0
    while length >= SHORTEST_STEP:
        after = now.moved(length * u)
        if after.residual < now.residual:
            return after
        length *= 0.5
    return None


def _worth(now: Balance, after: Balance, tolerance: float) -> bool:
    """Whether the factors that led from one state to the other fit: a decade was gained.

    Where contacts have opened or closed on the way the fault is not theirs.
    """
    decade = after.residual < max(GAIN * now.residual, tolerance)
    return decade or not np.array_equal(now.network, after.network)


def _let_go(balance: Balance) -> Balance:
    """The same if no loose grain touches anything, else the state with them moved out."""
    loose = ~balance.held
    if not np.any(loose[balance.contacts.i] | loose[balance.contacts.j]):
        return balance
    packing = moved_out(balance.packing, balance.interaction.normal, loose)
    # A grain that carries no load loses none.
    return replace(Balance.of(packing, balance.interaction, balance), lost=balance.lost)
