"""A packing, the backbone that carries its load, and its linear response.

J changes little from one equilibrium state to the next, so that the factors of an earlier J are
used again (`reused_factor`, `low_rank_update`). J is factored anew where they no longer suffice,
and after `MAX_REUSES` states.

| symbol | name          | shape, type                                 | unit         |
| ------ | ------------- | ------------------------------------------- | ------------ |
| q      | packing       | all N grains, rattlers included             |              |
| –      | backbone_mask | (N,) bool: grains that carry load           | 1            |
| F̃      | force         | (N', k) float64, of the N' backbone grains  | k_N d^(3/2)  |
| J      | matrix        | (kN', kN') sparse CSC                       | k_N d^(1/2)  |
| u      | –             | (kN',) or (N', k) float64                   | d            |
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.pinned_factor import PinnedFactor
from grainmodes.packing.forces import max_force_and_torque, net_force
from grainmodes.packing.jacobian import assemble, stiffness_of
from grainmodes.packing.state import Packing, rattlers, zero_on_rattlers
from grainmodes.relaxation.low_rank_update import BaseFactor, LowRankUpdate
from grainmodes.relaxation.newton import apply_slip, displace_with_springs
from grainmodes.relaxation.rattlers import rattler_threshold
from grainmodes.relaxation.released_force import force_released_on_opening
from grainmodes.relaxation.reused_factor import MAX_REUSES, ReusedFactor, solve_by_iteration


@dataclass(frozen=True)
class EquilibriumState:
    """A packing and what follows from it; in force balance once `find_equilibrium` returns it.

    `released_force` is the largest force, in k_N d^(3/2), that a contact bore when it opened on the
    way to this state (`force_released_on_opening`). `reuse_ordering_of` holds factors whose
    elimination order may suit this J.
    """

    packing: Packing
    backbone_mask: NDArray[np.bool_]
    interaction: Interaction
    reused: ReusedFactor | None = None
    reuse_ordering_of: PinnedFactor | None = None
    released_force: float = 0.0

    @classmethod
    def from_packing(
        cls,
        packing: Packing,
        interaction: Interaction,
        before: EquilibriumState | None = None,
    ) -> EquilibriumState:
        """The state of a packing after its springs have slipped, as far as the law requires.

        Args:
            before: the state it comes from. Its factors are reused where the same grains carry
                load, and its released force counts too.

        Raises:
            PackingError: two grains lie at the same place.
        """
        backbone_mask = ~rattlers(packing, rattler_threshold(interaction))
        released = force_released_on_opening(packing, interaction)
        slipped = apply_slip(packing, interaction)
        state = cls(slipped, backbone_mask, interaction, released_force=released)
        if before is None:
            return state
        released = max(released, before.released_force)
        return state._reusing(before, before.reused, before.reuse_ordering_of, released)

    def __reduce__(self):
        """Pickle the packing alone: factors are made again, and are the same."""
        return EquilibriumState.from_packing, (self.packing, self.interaction)

    def without_factors(self) -> EquilibriumState:
        """The same state without any factors, so that many states fit into memory."""
        return replace(self, reused=None, reuse_ordering_of=None)

    def with_factors_of(self, before: EquilibriumState) -> EquilibriumState:
        """The same state with the factors of an earlier one, if the same grains carry load.

        Raises:
            FloppyError: the backbone of `before` has zero modes beyond the translations.
        """
        reused = before.factors_for_next
        return self._reusing(before, reused, reused.base.factor, self.released_force)

    def _reusing(
        self,
        before: EquilibriumState,
        reused: ReusedFactor | None,
        reuse_ordering_of: PinnedFactor | None,
        released_force: float,
    ) -> EquilibriumState:
        same_grains = np.array_equal(self.backbone_mask, before.backbone_mask)
        return replace(
            self,
            reused=reused if same_grains else None,
            reuse_ordering_of=reuse_ordering_of,
            released_force=released_force,
        )

    @cached_property
    def backbone(self) -> Packing:
        """The grains that carry load, renumbered, with their springs."""
        if self.backbone_mask.all():
            return self.packing
        return self.packing.without(~self.backbone_mask)

    @cached_property
    def contact_keys(self) -> NDArray[np.int64]:
        """The key of every contact of the backbone, ascending, in the numbers of the packing."""
        contacts = self.packing.contacts
        both = self.backbone_mask[contacts.i] & self.backbone_mask[contacts.j]
        return contacts.key[both]

    @cached_property
    def force(self) -> NDArray[np.float64]:
        """F̃ on every grain of the backbone, (N', k) in k_N d^(3/2)."""
        return net_force(self.backbone, self.interaction)

    @cached_property
    def residual(self) -> float:
        """max|F̃| over the forces and scaled torques of the backbone, in k_N d^(3/2)."""
        return max(max_force_and_torque(self.force))

    @cached_property
    def stiffness(self) -> NDArray[np.float64]:
        """K of the contacts of the backbone, (C, k, k) in k_N d^(1/2)."""
        return stiffness_of(self.backbone.contacts, self.interaction)

    @cached_property
    def matrix(self) -> sparse.csc_array:
        """J of the backbone, (kN', kN') in k_N d^(1/2)."""
        contacts = self.backbone.contacts
        return assemble(self.stiffness, contacts.i, contacts.j, self.backbone.n)

    @cached_property
    def factor(self) -> PinnedFactor:
        """The factors of J.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        symmetric = self.backbone.contacts.spring_state is None
        return PinnedFactor(self.matrix, symmetric, reuse_ordering_of=self.reuse_ordering_of)

    @cached_property
    def low_rank_update(self) -> LowRankUpdate | None:
        """The reused factors corrected for this J; None if there are none or too much changed."""
        if self.reused is None:
            return None
        return self.reused.base.updated(self.backbone.contacts, lambda: self.stiffness)

    @property
    def base_factor(self) -> BaseFactor:
        """The factors of this J, to be reused by later states.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        return BaseFactor(self.factor, self.backbone.contacts, self.stiffness)

    @property
    def factors_for_next(self) -> ReusedFactor:
        """The factors for the next state: the reused ones until they are too old.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        reused = self.reused
        if reused is None or self.low_rank_update is None or reused.age >= MAX_REUSES:
            return ReusedFactor(self.base_factor, 1)
        return reused._replace(age=reused.age + 1)

    @property
    def unstable(self) -> bool:
        """Whether J has eigenvalues of negative real part.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        reused, update = self.reused, self.low_rank_update
        if reused is None or update is None:
            return self.factor.unstable
        if update.may_change_signs or reused.base.factor.unstable:
            return self.factor.unstable
        return False

    def solve(
        self, force: NDArray[np.float64], guess: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """u with J u = `force`, (kN',) in d.

        Args:
            force: kN' numbers in any shape.
            guess: a field near u, from which the iteration with reused factors starts.

        Raises:
            FloppyError: the backbone has zero modes beyond the translations.
        """
        if self.low_rank_update is None:
            return self.factor.solve(force)
        u = solve_by_iteration(self.matrix, self.low_rank_update, force.ravel(), guess)
        return self.factor.solve(force) if u is None else u

    def displaced(self, u: NDArray[np.float64]) -> EquilibriumState:
        """The state after a small displacement u of its backbone, (N', k) in d.

        Raises:
            PackingError: two grains then lie at the same place, or u is not finite.
        """
        everywhere = zero_on_rattlers(u, self.backbone_mask)
        packing = displace_with_springs(self.packing, self.interaction, everywhere)
        return EquilibriumState.from_packing(packing, self.interaction, self)
