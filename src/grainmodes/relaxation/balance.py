"""A force balance found from a state near it, contacts opening and closing on the way.

    q → q + J⁻¹ F̃        F̃ of the grains that carry load, until max|F̃| < tolerance

J changes little from one balance to the next, so its factors at the last one are kept as long as
they lower max|F̃| tenfold: between events a step of Δγ takes three solutions and no factorisation.
Where they do not (a contact has opened or closed, or the forces bend), J is factored anew and the
step shortened until max|F̃| falls. Each iterate is judged on its own contact network; grains that
lose their hold on the way are left out, and those that are touched come back in.

A balance may be a saddle. `Balance.unstable` tells by the factors of its J.

| symbol | name     | shape                                |
| ------ | -------- | ------------------------------------ |
| q      | packing  | all grains, the loose ones too       |
| –      | held     | (N,) bool: grains that carry load    |
| J      | matrix   | (kN', kN') of the N' held grains     |
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from grainmodes.forces import is_frictionless, largest, net_force, tangential_forces
from grainmodes.jacobian import jacobian
from grainmodes.kernels.laws import Interaction
from grainmodes.linear import FloppyError, PinnedFactor
from grainmodes.packing import Contacts, Packing, rattlers
from grainmodes.relaxation.newton import moved_by, slipped
from grainmodes.relaxation.rattlers import moved_out

NOTHING = 1e-100
"""Overlap of a contact that opens."""

MOST = 40
"""Iterations: ten times what a step between events needs."""

GAIN = 0.1
"""Part of max|F̃| that old factors must leave at most to be kept."""

SHORTEST_STEP = 0.1
"""Fraction of a Newton step below which it is given up."""


def most_loose(interaction: Interaction) -> int:
    """Most contacts of a grain that carries no load: with friction two may hold it."""
    return 2 if is_frictionless(interaction) else 1


@dataclass(frozen=True)
class Balance:
    """A state, its grains that carry load, and the forces between them."""

    packing: Packing
    contacts: Contacts
    held: np.ndarray
    interaction: Interaction
    before: PinnedFactor | None = None
    iterations: int = 0
    lost: float = 0.0

    @classmethod
    def of(
        cls, packing: Packing, interaction: Interaction, before: PinnedFactor | None = None
    ) -> Balance:
        """A state as it is, once its springs have slipped."""
        packing, contacts = slipped(packing, interaction)
        loose = rattlers(contacts, packing.n, most_loose(interaction))
        return cls(packing, contacts, ~loose, interaction, before)

    @cached_property
    def backbone(self) -> Packing:
        """The grains that carry load, with their springs."""
        return self.packing if self.held.all() else self.packing.without(~self.held)

    @cached_property
    def backbone_contacts(self) -> Contacts:
        """The contacts between them."""
        return self.contacts.among(self.held)

    @cached_property
    def force(self) -> np.ndarray:
        """F̃ on every grain that carries load, (N', k) in k_N d^(3/2)."""
        return net_force(self.backbone, self.backbone_contacts, self.interaction)

    @property
    def residual(self) -> float:
        """max|F̃|, forces and scaled torques."""
        return max(largest(self.force))

    @cached_property
    def factor(self) -> PinnedFactor:
        """The factors of J.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        contacts = self.backbone_contacts
        matrix = jacobian(self.backbone, contacts, self.interaction)
        return PinnedFactor(matrix, contacts.tangential_displacement is None, like=self.before)

    @property
    def unstable(self) -> bool:
        """Whether J has negative eigenvalues; if not symmetric, an odd number of them."""
        return self.factor.unstable

    def moved(self, u: np.ndarray) -> Balance:
        """The state after a motion u of its backbone, (N', k) in d."""
        everywhere = u
        if not self.held.all():
            everywhere = np.zeros((self.packing.n, u.shape[1]))
            everywhere[self.held] = u
        packing = moved_by(self.packing, self.contacts, self.interaction, everywhere)
        after = Balance.of(packing, self.interaction, self.before)
        return replace(
            after, lost=max(self.lost, lost_force(packing, after.contacts, self.interaction))
        )


def lost_force(packing: Packing, contacts: Contacts, interaction: Interaction) -> float:
    """Largest force that a contact of the history bore when it opened, at zero overlap.

    Nothing where the tangential force ends with the normal one: Hertz, Coulomb. A harmonic contact
    without slip lets go of k_T s at once.
    """
    history = packing.history
    if history is None or len(history.i) == len(contacts.i):
        return 0.0
    key = history.i.astype(np.int64) * packing.n + history.j
    gone = ~np.isin(key, contacts.i.astype(np.int64) * packing.n + contacts.j, assume_unique=True)
    s = history.tangential_displacement[gone]
    nothing = np.full(len(s), NOTHING)
    return float(np.abs(tangential_forces(interaction, nothing, s)).max(initial=0.0))


def find_balance(
    packing: Packing, interaction: Interaction, tolerance: float, before: Balance | None = None
) -> Balance | None:
    """The balance near a state, max|F̃| < `tolerance`; None where the iteration does not lead there.

    Args:
        before: the balance it comes from, whose factors are used as long as they do.
    """
    factor = before and before.factor
    now = Balance.of(packing, interaction, factor)
    now = replace(now, lost=lost_force(packing, now.contacts, interaction))
    if before and not np.array_equal(before.held, now.held):
        factor = None
    for iteration in range(MOST):
        if now.residual < tolerance:
            settled = _let_go(now)
            if settled is now:
                return replace(now, iterations=iteration)
            after, factor = settled, None
        else:
            after, factor = _step(now, factor)
            if after is None:
                return None
        factor = factor if np.array_equal(now.held, after.held) else None
        now = after
    return None


def _step(now: Balance, factor: PinnedFactor | None) -> tuple[Balance | None, PinnedFactor | None]:
    """The next iterate and the factors that led to it, None if they should not be used again."""
    if not now.held.any():
        return None, None
    if factor is not None:
        after = now.moved(_displacement(now, factor))
        if after.residual < GAIN * now.residual:
            return after, factor
    try:
        u = _displacement(now, now.factor)
    except FloppyError:
        return None, None
    length = 1.0
    while length >= SHORTEST_STEP:
        after = now.moved(length * u)
        if after.residual < now.residual:
            return after, now.factor if length == 1.0 else None
        length *= 0.5
    return None, None


def _displacement(now: Balance, factor: PinnedFactor) -> np.ndarray:
    return factor.solve(now.force, refined=False).reshape(now.force.shape)


def _let_go(balance: Balance) -> Balance:
    """The same if no loose grain touches anything, else the state with them moved out."""
    loose = ~balance.held
    if not np.any(loose[balance.contacts.i] | loose[balance.contacts.j]):
        return balance
    packing = moved_out(balance.packing, balance.interaction.normal, loose)
    return Balance.of(packing, balance.interaction, balance.before)
