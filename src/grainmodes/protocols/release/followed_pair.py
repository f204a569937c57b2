"""The released pair along its own dynamics: when it dies: C, Sec. VI B (3), inset of Fig. 8.

In a state of the run the invariant subspace of M⁻¹J that inverse iteration finds from that of the
start is the same pair if their projector overlap is above 0.7. Its λ_i is 0 where the two
eigenvalues are real, and where the subspace is lost to other modes: the pair is dead there.

In the last turns of the growth the pair comes and goes, as J moves with every excursion. It has
died with the first of five states in a row in which it is dead.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from grainmodes.complex_pairs.inverse_iteration import (
    INVARIANCE_TOLERANCE,
    InvariantSubspace,
    nearest_subspace,
    subspace_spanned_by,
)
from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import mass_weighted_jacobian, root_mass
from grainmodes.packing.state import Packing
from grainmodes.protocols.release.unstable_state import UnstableState

MIN_FOLLOWED_OVERLAP = 0.7
"""Projector overlap with the pair of the start, below which the subspace is another one."""

DEATH_STATES = 5
"""Number of states in a row without the pair by which it has died."""

MAX_LOSSES = 10
"""Number of states in a row without the pair after which it is not looked for again."""


@dataclass
class FollowedPair:
    """The subspace of a pair at the start, and (step, λ_i) of the states in which it was sought."""

    subspace: InvariantSubspace
    imaginary: list[tuple[int, float]] = field(default_factory=list)

    @classmethod
    def from_state(cls, start: UnstableState, interaction: Interaction) -> FollowedPair:
        """The pair of a state that is released, its left vectors found by inverse iteration."""
        matrix = mass_weighted_jacobian(jacobian(start.packing, interaction), start.packing.mass)
        vector = (start.mode * root_mass(start.packing.mass)).ravel()
        plane = np.stack([vector.real, vector.imag], axis=1)
        return cls(nearest_subspace(matrix, subspace_spanned_by(matrix, plane, plane)))

    @property
    def is_lost(self) -> bool:
        """Whether the pair is dead for good."""
        last = [value for _, value in self.imaginary[-MAX_LOSSES:]]
        return len(last) == MAX_LOSSES and not any(last)

    @property
    def death_step(self) -> int | None:
        """The step at which the pair has died; None if it lives to the end."""
        alive = [value > 0.0 for _, value in self.imaginary]
        for place in range(len(alive) - DEATH_STATES + 1):
            if not any(alive[place : place + DEATH_STATES]):
                return self.imaginary[place][0]
        return None

    def follow(self, step: int, packing: Packing, interaction: Interaction) -> None:
        """Find λ_i of the pair in a state of the run, in 1/t_0²."""
        value = 0.0 if self.is_lost else self._imaginary_in(packing, interaction)
        self.imaginary.append((step, value))

    def _imaginary_in(self, packing: Packing, interaction: Interaction) -> float:
        matrix = mass_weighted_jacobian(jacobian(packing, interaction), packing.mass)
        try:
            found = nearest_subspace(matrix, self.subspace)
        except NUMERICAL_ERRORS:
            return 0.0
        same = found.overlap_with(self.subspace) > MIN_FOLLOWED_OVERLAP
        if not (same and found.is_pair and found.residual <= INVARIANCE_TOLERANCE):
            return 0.0
        return float(found.values[0].imag)
