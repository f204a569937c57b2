"""The complex pairs of one J after the other, without solving any of them anew.

Eigenvectors change little from one state of a shear to the next. In those of the state before,
columns V, the next K is nearly diagonal:

    B = V⁻¹ K V = Λ + V⁻¹ (K V − V Λ)

and `nearly_diagonal` gives its eigenvalues and the new vectors, V X. V is real: for a complex pair
it holds Re u and Im u. It need not be exact, and all of a pass is in single precision. What matters
is the distance from V to the eigenvectors, told by the coupling, and each pass takes it to its
square. Every pair, and every two real eigenvalues that may be one, is then a plane with a residual
in double precision (`couples`), and is sharpened until that is small (`sharpening`):

| after a pass                                 | then                                              |
| -------------------------------------------- | ------------------------------------------------- |
| every plane has become sharp                 | the pairs are the planes with complex eigenvalues |
| coupling above `ENOUGH`, a sum that is off,  | another pass from the new vectors, `MOST` at most |
| too many planes in doubt, one stays blunt    |                                                   |
| an eigenvalue is missing or there twice      | the same pass halfway, or a quarter of the way    |
| and there as well                            | LAPACK                                            |

Grains that come to carry load or cease to change the size of K. For one state it stands on the
grains of both, the basis with a unit vector for every coordinate of a grain that came; the vectors
that have gone to the grains that ceased are then left out.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.definition import Loaded, Pairs, dense_eigenpairs, selected
from grainmodes.complex_pairs.eigenbasis import Basis
from grainmodes.complex_pairs.partitioning import NearlyDiagonal, Solved, solved
from grainmodes.complex_pairs.refinement import sharpened

ENOUGH = 1.0
"""Largest part of an eigenvector outside its window with which a pass is believed."""

SUM_RIGHT = 1e-3
"""What the sum of the eigenvalues may be off by."""

MOST = 5
"""Passes, after which LAPACK costs no more."""

PARTS = (0.5, 0.25)
"""How far to go where the whole way is too far for the windows."""


class Carried:
    """Finds pairs by carrying the eigenvectors of the last matrix on; `dense`: LAPACK did it."""

    def __init__(self) -> None:
        self._basis: Basis | None = None
        self._held = np.zeros(0, bool)
        self.dense = True

    def find(self, loaded: Loaded) -> Pairs:
        """Every complex pair of K; its zero modes are carried like all others.

        Raises:
            numpy.linalg.LinAlgError: the dense eigensolver did not converge.
        """
        if len(loaded.held) != len(self._held):
            return self._anew(loaded)
        either = np.repeat(self._held | loaded.held, 3)
        came, stays = (np.repeat(of, 3)[either] for of in (~self._held, loaded.held))
        self._basis = self._basis.with_units(came)
        pairs = self._carried_on(_on(stays, loaded.matrix))
        if pairs is None:
            return self._anew(loaded)
        self._basis, self._held = self._basis.without(~stays), loaded.held
        self.dense = False
        return Pairs(pairs.value, pairs.right[stays], pairs.left[stays])

    def _carried_on(self, matrix: sparse.csr_array) -> Pairs | None:
        """The pairs of the first pass that is believed; None where there is none."""
        for _ in range(MOST):
            found = self._pass(matrix)
            if found is None:
                break
            if found.coupling.max() < ENOUGH and found.missing < SUM_RIGHT:
                couples = sharpened(matrix, self._basis, found)
                if couples is not None:
                    return couples.pairs
        return None

    def _pass(self, matrix: sparse.csr_array) -> Solved | None:
        """The eigenpairs of B, or of a matrix on the way to it; the basis goes on to them."""
        vectors = self._basis.vectors
        moved = matrix.astype(np.float32) @ vectors
        diagonal = np.einsum("nk,nk->k", vectors, moved)
        change = self._basis.inverse @ (moved - vectors * diagonal)
        nearly = NearlyDiagonal.of(diagonal.astype(float), change)
        found = solved(nearly) or _on_the_way(nearly)
        if found is not None:
            self._basis = Basis.of(vectors[:, nearly.order] @ found.rows.T)
        return found

    def _anew(self, loaded: Loaded) -> Pairs:
        """By LAPACK, the vectors kept."""
        values, left, right = dense_eigenpairs(loaded.matrix)
        order = np.lexsort((-values.imag, values.real))
        self._basis = Basis.of(np.where(values.imag < 0.0, -right.imag, right.real)[:, order])
        self._held, self.dense = loaded.held, True
        return selected(values, right, left)


def _on_the_way(matrix: NearlyDiagonal) -> Solved | None:
    """The eigenpairs of the first nearer matrix that has all of them; not to be believed."""
    for part in PARTS:
        found = solved(matrix.partly(part))
        if found is not None:
            return found._replace(missing=np.inf)
    return None


def _on(these: np.ndarray, matrix: sparse.csr_array) -> sparse.csr_array:
    """A matrix (K, K) in the K of M coordinates that are `these`, (M,) bool; 0 in the others."""
    if these.all():
        return matrix
    place = sparse.eye_array(len(these), format="csr")[:, np.flatnonzero(these)]
    return (place @ matrix @ place.T).tocsr()
