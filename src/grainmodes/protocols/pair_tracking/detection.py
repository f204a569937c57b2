"""The complex pairs of one state of a walk, by a detector that may remember the state before."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from grainmodes.complex_pairs.continuation import EigenbasisContinuation
from grainmodes.complex_pairs.definition import (
    ComplexPairs,
    DynamicalMatrix,
    dense_pairs,
    on_all_grains,
    translations,
)
from grainmodes.complex_pairs.disc_sweep import pairs_by_windows
from grainmodes.complex_pairs.inverse_iteration import plane_of
from grainmodes.complex_pairs.matching import Planes
from grainmodes.packing.mass_weighted import mass_weighted_jacobian, root_mass
from grainmodes.protocols.pair_tracking.exceptional_points import Side
from grainmodes.relaxation.equilibrium_state import EquilibriumState


class Detector(Protocol):
    """Finds the complex pairs of one matrix after the other."""

    dense: bool
    """Whether LAPACK solved the last one."""

    def find(self, loaded: DynamicalMatrix) -> ComplexPairs:
        """Every complex pair of K on the grains that carry load."""


class ByLapack:
    """The definition: every matrix solved anew."""

    dense = True

    def find(self, loaded: DynamicalMatrix) -> ComplexPairs:
        """Every complex pair of K."""
        return dense_pairs(loaded.matrix)


class ByWindows:
    """Every matrix solved anew, in windows: for states too large for LAPACK."""

    dense = False

    def find(self, loaded: DynamicalMatrix) -> ComplexPairs:
        """Every complex pair of K.

        Raises:
            ArithmeticError: an iteration did not converge, or the eigenvalues do not add up.
        """
        return pairs_by_windows(loaded.matrix, loaded.null)


DETECTORS: dict[str, type[Detector]] = {
    "continuation": EigenbasisContinuation,
    "dense": ByLapack,
    "discs": ByWindows,
}
"""How pairs are found, by the name of the choice."""


@dataclass(frozen=True, eq=False)
class Seen:
    """A state with its pairs, their vectors on all grains."""

    equilibrium: EquilibriumState
    pairs: ComplexPairs

    @cached_property
    def planes(self) -> Planes:
        """The planes of the pairs."""
        return Planes.of(self.pairs)

    @property
    def strain(self) -> float:
        """γ."""
        return self.equilibrium.packing.strain

    def motions(self, places: np.ndarray) -> np.ndarray:
        """q = M^(−1/2) u of some of the pairs, (N, 3, P) complex."""
        scale = 1.0 / root_mass(self.equilibrium.packing.mass)
        return self.pairs.right[:, places].reshape(*scale.shape, -1) * scale[:, :, None]

    def side(self, place: int) -> Side:
        """The state with the plane of one of its pairs."""
        held = np.repeat(self.equilibrium.backbone_mask, 3)
        right, left = (
            np.stack([of[held, place].real, of[held, place].imag], axis=1)
            for of in (self.pairs.right, self.pairs.left)
        )
        matrix = mass_weighted_jacobian(self.equilibrium.matrix, self.equilibrium.backbone.mass)
        return Side(self.equilibrium, plane_of(matrix, right, left))


def seen_by(detector: Detector, equilibrium: EquilibriumState) -> Seen:
    """A state with the pairs that a detector finds in it."""
    mass = equilibrium.backbone.mass
    matrix = mass_weighted_jacobian(equilibrium.matrix, mass)
    found = detector.find(DynamicalMatrix(matrix, translations(mass), equilibrium.backbone_mask))
    right, left = (on_all_grains(of, equilibrium.backbone_mask) for of in (found.right, found.left))
    return Seen(equilibrium, ComplexPairs(found.value, right, left))
