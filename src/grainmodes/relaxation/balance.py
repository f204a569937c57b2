"""A state, the grains in it that carry load, and its linear response.

J changes little from one balance to the next. The factors of an earlier J, `fitted` to the contacts
that have changed since, still solve this one by iteration, u → u + J₁⁻¹ (f − J u), as long as that
gains a decade each time; then ‖1 − J₁⁻¹ J‖ < 1, so that no eigenvalue changes its sign between J₁
and J. Otherwise, and after `OLDEST` states, J is factored anew.

| symbol | name      | shape                                  |
| ------ | --------- | -------------------------------------- |
| q      | packing   | all grains, the loose ones too         |
| –      | held      | (N,) bool: grains that carry load      |
| F̃      | force     | (N', k) on the N' held grains          |
| J      | matrix    | (kN', kN')                             |
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.pinned_factor import PinnedFactor
from grainmodes.packing.contacts import Contacts, rattlers
from grainmodes.packing.forces import is_frictionless, largest, net_force, tangential_forces
from grainmodes.packing.jacobian import assemble, stiffness_of
from grainmodes.packing.state import Packing
from grainmodes.relaxation.low_rank_update import Fitted, Origin
from grainmodes.relaxation.newton import moved_by, slipped

GAIN = 0.1
"""Part of a residual that inherited factors must leave at most to be used."""

OLDEST = 20
"""States that the factors of one J serve at most."""

EXACT = 1e-12
"""Relative residual of a solution by inherited factors."""

NOTHING = 1e-100
"""Overlap of a contact that opens."""


class Inherited(NamedTuple):
    """An earlier J, and how many states its factors have served."""

    origin: Origin
    age: int


@dataclass(frozen=True)
class Balance:
    """A state and what follows from it; in balance once `find_balance` returns it.

    `lost` is the largest force that a contact bore when it opened on the way here (`lost_force`),
    `like` has factors whose order of elimination may do for this J.
    """

    packing: Packing
    contacts: Contacts
    held: np.ndarray
    interaction: Interaction
    inherited: Inherited | None = None
    like: PinnedFactor | None = None
    lost: float = 0.0

    @classmethod
    def of(
        cls,
        packing: Packing,
        interaction: Interaction,
        before: Balance | None = None,
    ) -> Balance:
        """A state as it is, once its springs have slipped; what it inherits is from `before`."""
        moved, contacts = slipped(packing, interaction)
        held = ~rattlers(contacts, packing.n, most_loose(interaction))
        now = cls(
            moved, contacts, held, interaction, lost=lost_force(packing, contacts, interaction)
        )
        if before is None:
            return now
        return now._given(before, before.inherited, before.like, max(now.lost, before.lost))

    def __reduce__(self):
        """Pickled as its packing: factors are made again, and are the same."""
        return Balance.of, (self.packing, self.interaction)

    def bare(self) -> Balance:
        """The same state without factors, its own or others': of many states in memory."""
        return replace(self, inherited=None, like=None)

    def heir_of(self, before: Balance) -> Balance:
        """The same state with the factors of an earlier one, if it is of the same grains."""
        inherited = before.handed_on
        return self._given(before, inherited, inherited.origin.factor, self.lost)

    def _given(self, before: Balance, inherited: Inherited | None, like, lost: float) -> Balance:
        """The same state with what `before` leaves to the same grains."""
        same = np.array_equal(self.held, before.held)
        return replace(self, inherited=inherited if same else None, like=like, lost=lost)

    @cached_property
    def backbone(self) -> Packing:
        """The grains that carry load, with their springs."""
        return self.packing if self.held.all() else self.packing.without(~self.held)

    @cached_property
    def backbone_contacts(self) -> Contacts:
        """The contacts between them."""
        return self.contacts.among(self.held)

    @cached_property
    def network(self) -> np.ndarray:
        """One number for every contact between grains that carry load, ascending."""
        contacts = self.contacts
        both = self.held[contacts.i] & self.held[contacts.j]
        return (contacts.i.astype(np.int64) * self.packing.n + contacts.j)[both]

    @cached_property
    def force(self) -> np.ndarray:
        """F̃ on every grain that carries load, (N', k) in k_N d^(3/2)."""
        return net_force(self.backbone, self.backbone_contacts, self.interaction)

    @cached_property
    def residual(self) -> float:
        """max|F̃|, forces and scaled torques."""
        return max(largest(self.force))

    @cached_property
    def stiffness(self) -> np.ndarray:
        """K of the contacts between them, (C, k, k)."""
        return stiffness_of(self.backbone_contacts, self.interaction)

    @cached_property
    def matrix(self) -> sparse.csc_array:
        """J of the grains that carry load."""
        contacts = self.backbone_contacts
        return assemble(self.stiffness, contacts.i, contacts.j, self.backbone.n)

    @cached_property
    def factor(self) -> PinnedFactor:
        """The factors of J.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        symmetric = self.backbone_contacts.spring_state is None
        return PinnedFactor(self.matrix, symmetric, reuse_ordering_of=self.like)

    @cached_property
    def fitted(self) -> Fitted | None:
        """The inherited factors for this J; None where there are none, or too much has changed."""
        if self.inherited is None:
            return None
        return self.inherited.origin.fitted(self.backbone_contacts, lambda: self.stiffness)

    @property
    def origin(self) -> Origin:
        """This J, for later ones.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        return Origin(self.factor, self.backbone_contacts, self.stiffness)

    @property
    def handed_on(self) -> Inherited:
        """The factors for the next state: those inherited until they are too old."""
        if self.fitted is None or self.inherited.age >= OLDEST:
            return Inherited(self.origin, 1)
        return self.inherited._replace(age=self.inherited.age + 1)

    @property
    def unstable(self) -> bool:
        """Whether J has negative eigenvalues."""
        if self.fitted is None or self.fitted.turned or self.inherited.origin.factor.unstable:
            return self.factor.unstable
        return False

    def solved(self, force: np.ndarray, near: np.ndarray | None = None) -> np.ndarray:
        """u with J u = `force`, (kN',); inherited factors start from a field `near` it.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        if self.fitted is None:
            return self.factor.solve(force)
        wanted = force.ravel()
        goal = EXACT * np.abs(wanted).max(initial=0.0)
        u, left = np.zeros(len(wanted)), wanted
        if near is not None and near.size == len(wanted):
            u = near.ravel()
            left = wanted - self.matrix @ u
        while (size := np.abs(left).max(initial=0.0)) > goal:
            u = u + self.fitted.solve(left)
            left = wanted - self.matrix @ u
            if not np.abs(left).max() < max(GAIN * size, goal):
                return self.factor.solve(force)
        return u

    def moved(self, u: np.ndarray) -> Balance:
        """The state after a motion u of its backbone, (N', k) in d."""
        everywhere = u
        if not self.held.all():
            everywhere = np.zeros((self.packing.n, u.shape[1]))
            everywhere[self.held] = u
        packing = moved_by(self.packing, self.contacts, self.interaction, everywhere)
        return Balance.of(packing, self.interaction, self)


def most_loose(interaction: Interaction) -> int:
    """Most contacts of a grain that carries no load: with friction two may hold it."""
    return 2 if is_frictionless(interaction) else 1


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
    s = history.spring_state[gone]
    nothing = np.full(len(s), NOTHING)
    return float(np.abs(tangential_forces(interaction, nothing, s)).max(initial=0.0))
