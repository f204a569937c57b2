"""Direct solution of J u = b for the backbone of a packing.

The two translations are pinned at grain 0 (its x and y, never its rotation). A symmetric J is the
shift 0 of `shift`: scaled rows, factors of one triangle. Any other J is scaled by 1/√|J_ii| on both
sides likewise, since the rotational rows of a weakly frictional packing are k_T/k_N times smaller
than the others. Its pattern is symmetric, so it is factored in a symmetric order without pivoting,
in half the time; where a pivot fails, by SuperLU with row pivoting.
"""

from __future__ import annotations

from copy import copy
from functools import cache, cached_property

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigs, splu

from grainmodes.kernels.permutations import odd
from grainmodes.linalg.factorisation import SuperLU, ZeroPivotError
from grainmodes.linalg.symmetric_shift import SymmetricShift

SOFTEST = 1e12
"""Largest response of the scaled Jacobian to a generic force that rounding lets one believe."""


LOWEST = 12
"""Eigenvalues next to zero in which a negative one is sought."""

FEW = 60
"""Unknowns up to which all of them are looked at."""


class FloppyError(ArithmeticError):
    """The Jacobian has zero modes beyond the translations: no unique response exists."""


class PinnedFactor:
    """The factors of a scaled Jacobian whose first two unknowns are pinned to zero.

    Args:
        matrix: J, (kN, kN) sparse CSC.
        symmetric: J is symmetric: every s = 0.
        backend: the factorisation of a symmetric J.
        like: factors of another J, whose order of elimination is taken over if it suits.

    Raises:
        FloppyError: the pinned matrix is singular, or so nearly that no digit would be right.
    """

    def __init__(
        self,
        matrix: sparse.csc_array,
        symmetric: bool,
        backend: str = "auto",
        like: PinnedFactor | None = None,
    ):
        self.size = matrix.shape[0]
        self._symmetric = symmetric
        self._matrix = matrix[2:, 2:]
        diagonal = np.abs(self._matrix.diagonal())
        if np.any(diagonal == 0.0):
            raise FloppyError("a degree of freedom has no stiffness at all")
        try:
            self._factor = (
                SymmetricShift(self._matrix, backend).to(0.0)
                if symmetric
                else _General(self._matrix, diagonal, like and like._factor)
            )
        except (RuntimeError, ArithmeticError) as error:
            raise FloppyError(f"the Jacobian is singular ({error})") from error
        self._probe(np.sqrt(diagonal))

    def _probe(self, root: np.ndarray) -> None:
        """A zero mode beyond the pinned ones answers any generic force beyond all bounds."""
        force = _generic(len(root))
        answer = root * self._factor.solve(root * force)
        if not np.linalg.norm(answer) < SOFTEST * np.linalg.norm(force):
            raise FloppyError("the Jacobian has zero modes beyond the two translations")

    @cached_property
    def unstable(self) -> bool:
        """Whether J has eigenvalues of negative real part.

        A symmetric J has as many as negative pivots. Of any J an odd number of negative pivots
        means an odd number of negative eigenvalues; an even one may mean none, and the `LOWEST`
        eigenvalues of the pinned J decide.
        """
        count = self._factor.count
        if self._symmetric or count % 2 or not count:
            return count > 0
        return bool(self._lowest().real.min() < 0.0)

    def _lowest(self) -> np.ndarray:
        """Eigenvalues of the pinned J next to zero, complex."""
        size = self._matrix.shape[0]
        if size <= FEW:
            return np.linalg.eigvals(self._matrix.toarray())
        inverse = LinearOperator((size, size), matvec=self._factor.solve, dtype=float)
        return 1.0 / eigs(inverse, k=LOWEST, v0=_generic(size), return_eigenvectors=False)

    def solve(self, force: np.ndarray, refined: bool = True) -> np.ndarray:
        """u with J u = `force`, (kN,), refined once or not; u of grain 0 is zero in x, y."""
        wanted = force.ravel()[2:]
        free = self._factor.solve(wanted)
        if refined:
            free += self._factor.solve(wanted - self._matrix @ free)
        return np.concatenate([np.zeros(2), free])


@cache
def _generic(size: int) -> np.ndarray:
    """A force without any symmetry, (M,)."""
    return np.random.default_rng(0).standard_normal(size)


class _General:
    """Factors of a matrix of symmetric pattern; `count` of its negative pivots."""

    def __init__(self, matrix: sparse.csc_array, diagonal: np.ndarray, like):
        self._scale = 1.0 / np.sqrt(diagonal)
        column = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
        scaled = self._scale[matrix.indices] * matrix.data * self._scale[column]
        self._pattern = matrix.indptr, matrix.indices
        self._factors = like.ordered(self._pattern) if isinstance(like, _General) else None
        self._factors = self._factors or SuperLU(matrix)
        try:
            self.count = self._factors.refill(scaled)
        except ZeroPivotError:
            entries = (scaled, matrix.indices, matrix.indptr)
            self._factors = splu(sparse.csc_array(entries, shape=matrix.shape))
            signs = np.count_nonzero(self._factors.U.diagonal() < 0.0)
            self.count = (signs + odd(self._factors.perm_r) + odd(self._factors.perm_c)) % 2

    def ordered(self, pattern: tuple[np.ndarray, np.ndarray]) -> SuperLU | None:
        """Factors to be refilled in the order of these, where the pattern is the same."""
        same = all(map(np.array_equal, self._pattern, pattern))
        return copy(self._factors) if same and isinstance(self._factors, SuperLU) else None

    def solve(self, force: np.ndarray) -> np.ndarray:
        return self._scale * self._factors.solve(self._scale * force)
