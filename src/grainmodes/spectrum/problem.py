"""The eigenproblem of a packing: J of its backbone, or of all its grains."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.state import Packing, backbone, find_contacts


@dataclass(frozen=True)
class Problem:
    """A sparse matrix (M, M), k_N d^(1/2), whose rows come k to a grain: (x, y[, ℓ])."""

    matrix: sparse.csc_array
    k: int
    symmetric: bool

    @property
    def size(self) -> int:
        """M, the number of modes."""
        return self.matrix.shape[0]

    @property
    def bound(self) -> float:
        """A number above every |λ| (Gershgorin); 0 for an empty matrix."""
        rows = np.abs(self.matrix).sum(axis=1)
        return 1.0001 * float(rows.max(initial=0.0))

    @property
    def translations(self) -> np.ndarray:
        """The two zero modes of every J, (M, 2), orthonormal."""
        along = np.zeros((self.size, 2))
        for axis in range(2):
            along[axis :: self.k, axis] = np.sqrt(self.k / max(self.size, 1))
        return along

    def shift(self, backend: str = "auto") -> SymmetricShift:
        """J − σ for a symmetric J, which knows its translations."""
        return SymmetricShift(self.matrix, backend, self.translations)


def problem(
    packing: Packing, interaction: Interaction, threshold: int = 2, keep_rattlers: bool = False
) -> Problem:
    """J of a packing without its rattlers (at most `threshold` contacts), or with them: A (18)."""
    grains = packing if keep_rattlers else backbone(packing, threshold)
    contacts = find_contacts(grains)
    matrix = jacobian(grains, contacts, interaction)
    k = matrix.shape[0] // max(grains.n, 1) if grains.n else 3
    return Problem(matrix, k, symmetric=contacts.spring_state is None)
