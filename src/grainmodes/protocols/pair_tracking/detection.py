"""The complex pairs of one state, by a detector that may remember the state before."""

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
    translations,
    vectors_on_all_grains,
)
from grainmodes.complex_pairs.disc_sweep import pairs_by_disc_sweep
from grainmodes.complex_pairs.inverse_iteration import subspace_spanned_by
from grainmodes.complex_pairs.matching import PairProjectors
from grainmodes.packing.mass_weighted import mass_weighted_jacobian, root_mass
from grainmodes.protocols.pair_tracking.exceptional_points import TwoModeState
from grainmodes.relaxation.equilibrium_state import EquilibriumState


class Detector(Protocol):
    """Finds the complex pairs of one matrix after the other."""

    dense: bool
    """Whether LAPACK solved the last one."""

    def find(self, problem: DynamicalMatrix) -> ComplexPairs:
        """All complex pairs of K on the backbone."""


class DenseDetector:
    """The definition: LAPACK solves every matrix anew."""

    dense = True

    def find(self, problem: DynamicalMatrix) -> ComplexPairs:
        """All complex pairs of K.

        Raises:
            numpy.linalg.LinAlgError: the eigensolver did not converge.
        """
        return dense_pairs(problem.matrix)


class DiscDetector:
    """A disc sweep solves every matrix anew: for states too large for LAPACK."""

    dense = False

    def find(self, problem: DynamicalMatrix) -> ComplexPairs:
        """All complex pairs of K.

        Raises:
            ArithmeticError: an iteration did not converge, or the eigenvalues do not add up.
        """
        return pairs_by_disc_sweep(problem.matrix, problem.null)


DETECTORS: dict[str, type[Detector]] = {
    "continuation": EigenbasisContinuation,
    "dense": DenseDetector,
    "discs": DiscDetector,
}
"""How pairs are found, by the name of the choice."""


@dataclass(frozen=True, eq=False)
class PairState:
    """A state in equilibrium with its complex pairs, their vectors (3N, P) on all grains."""

    equilibrium: EquilibriumState
    pairs: ComplexPairs

    @cached_property
    def projectors(self) -> PairProjectors:
        """The projectors on the planes of the pairs."""
        return PairProjectors.from_pairs(self.pairs)

    @property
    def strain(self) -> float:
        """γ."""
        return self.equilibrium.packing.strain

    def motions(self, places: np.ndarray) -> np.ndarray:
        """q = M^(−1/2) u of the pairs at some places (P,), (N, 3, P) complex128."""
        scale = 1.0 / root_mass(self.equilibrium.packing.mass)
        return self.pairs.right[:, places].reshape(*scale.shape, -1) * scale[:, :, None]

    def two_modes(self, place: int) -> TwoModeState:
        """The state with the subspace of one of its pairs."""
        equilibrium = self.equilibrium
        backbone = np.repeat(equilibrium.backbone_mask, 3)
        right, left = (
            np.stack([vectors[backbone, place].real, vectors[backbone, place].imag], axis=1)
            for vectors in (self.pairs.right, self.pairs.left)
        )
        matrix = mass_weighted_jacobian(equilibrium.matrix, equilibrium.backbone.mass)
        return TwoModeState(equilibrium, subspace_spanned_by(matrix, right, left))


def detect_pairs(detector: Detector, equilibrium: EquilibriumState) -> PairState:
    """A state with the pairs that a detector finds in it.

    Raises:
        ArithmeticError: an iteration did not converge.
        numpy.linalg.LinAlgError: the dense eigensolver did not converge.
    """
    mass, backbone = equilibrium.backbone.mass, equilibrium.backbone_mask
    matrix = mass_weighted_jacobian(equilibrium.matrix, mass)
    found = detector.find(DynamicalMatrix(matrix, translations(mass), backbone))
    right, left = (
        vectors_on_all_grains(vectors, backbone) for vectors in (found.right, found.left)
    )
    return PairState(equilibrium, ComplexPairs(found.value, right, left))
