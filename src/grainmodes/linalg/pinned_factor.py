"""Direct solution of J u = b for a J whose first two unknowns are pinned to zero.

Pinning removes two zero modes that are known beforehand: in a packing these are the two
translations, which are pinned at the x and y of its first grain, never at its rotation. A symmetric
J is factored by `SymmetricShift` at the shift 0. Any other J has its rows and columns scaled by
1/√|J_ii| in the same way, since some rows may be many orders smaller than others. Its pattern is
symmetric, so that it is factored in a symmetric order without pivoting, in half the time; where a
pivot fails, SuperLU with row pivoting is used instead.

| symbol | name   | meaning                                                       |
| ------ | ------ | ------------------------------------------------------------- |
| J      | matrix | (M, M) sparse CSC, its pattern symmetric                      |
| b      | right  | (M,); its first two entries are not read                      |
| u      | –      | (M,); its first two entries are zero                          |
"""

from __future__ import annotations

from copy import copy
from functools import cache, cached_property

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, eigs
from scipy.sparse.linalg import SuperLU as PivotedFactors

from grainmodes.kernels.permutations import is_odd
from grainmodes.linalg.factorisation import ZeroPivotError
from grainmodes.linalg.failures import NUMERICAL_ERRORS
from grainmodes.linalg.superlu import SuperLU, factors_of
from grainmodes.linalg.symmetric_shift import SymmetricShift

SINGULAR_RESPONSE = 1e12
"""Response to a random right-hand side, relative to it, above which the scaled J counts as
numerically singular."""

N_LOWEST = 12
"""Number of eigenvalues nearest zero among which a negative one is searched."""

MAX_DENSE_SIZE = 60
"""Number of unknowns up to which a dense solver computes all eigenvalues instead."""


class FloppyError(ArithmeticError):
    """The matrix has zero modes beyond the pinned ones: no unique solution exists."""


class PinnedFactor:
    """The factors of a scaled J whose first two unknowns are pinned to zero.

    Attributes:
        size: M, the number of unknowns with the pinned ones.

    Args:
        matrix: J, (M, M) sparse CSC.
        symmetric: whether J is symmetric.
        backend: the factorisation of a symmetric J, see `backends.make_factorisation`.
        reuse_ordering_of: factors of another J; their elimination order is used again if they are
            not of a symmetric J and their sparsity pattern is the same.

    Raises:
        FloppyError: the pinned J is singular, or so nearly that no digit would be right.
    """

    def __init__(
        self,
        matrix: sparse.csc_array,
        symmetric: bool,
        backend: str = "auto",
        reuse_ordering_of: PinnedFactor | None = None,
    ):
        self.size = matrix.shape[0]
        self._symmetric = symmetric
        self._matrix = matrix[2:, 2:]
        diagonal = np.abs(self._matrix.diagonal())
        if np.any(diagonal == 0.0):
            raise FloppyError("a degree of freedom has no stiffness at all")
        earlier = None if reuse_ordering_of is None else reuse_ordering_of._factor
        self._factor: SymmetricShift | _GeneralFactor
        try:
            if symmetric:
                self._factor = SymmetricShift(self._matrix, backend).factor_at(0.0)
            else:
                self._factor = _GeneralFactor(self._matrix, diagonal, earlier)
        except NUMERICAL_ERRORS as error:
            raise FloppyError(f"the Jacobian is singular ({error})") from error
        self._check_response(np.sqrt(diagonal))

    def _check_response(self, root: NDArray[np.float64]) -> None:
        """Refuse a J with further zero modes: its response to a random force is unbounded."""
        force = _random_force(len(root))
        response = root * self._factor.solve(root * force)
        if not np.linalg.norm(response) < SINGULAR_RESPONSE * np.linalg.norm(force):
            raise FloppyError("the Jacobian has zero modes beyond the two translations")

    @cached_property
    def unstable(self) -> bool:
        """Whether the pinned J has eigenvalues of negative real part.

        A symmetric J has as many of them as negative pivots. For any J, an odd number of negative
        pivots means an odd number of negative eigenvalues, since their signs multiply to that of
        the determinant. An even number may mean that there are none: then the `N_LOWEST`
        eigenvalues nearest zero decide.
        """
        negative = self._factor.n_below
        if self._symmetric or negative % 2 or not negative:
            return negative > 0
        return bool(self._lowest_eigenvalues().real.min() < 0.0)

    def _lowest_eigenvalues(self) -> NDArray[np.complex128]:
        """Eigenvalues of the pinned J nearest zero."""
        size = self._matrix.shape[0]
        if size <= MAX_DENSE_SIZE:
            return np.linalg.eigvals(self._matrix.toarray())
        inverse = LinearOperator((size, size), matvec=self._factor.solve, dtype=float)
        start = _random_force(size)
        values: NDArray[np.complex128] = eigs(
            inverse, k=N_LOWEST, v0=start, return_eigenvectors=False
        )
        return 1.0 / values

    def solve(self, right: NDArray[np.float64], refined: bool = True) -> NDArray[np.float64]:
        """u (M,) with J u = b, its first two entries zero.

        Args:
            right: b, M numbers in any shape.
            refined: whether to improve u once with the residual b − J u.
        """
        wanted = right.ravel()[2:]
        free = self._factor.solve(wanted)
        if refined:
            free += self._factor.solve(wanted - self._matrix @ free)
        return np.concatenate([np.zeros(2), free])


@cache
def _random_force(size: int) -> NDArray[np.float64]:
    """The same random numbers (M,) in every process."""
    return np.random.default_rng(0).standard_normal(size)


class _GeneralFactor:
    """Factors of a scaled matrix of symmetric pattern; `n_below` is its number of negative pivots.

    With row pivoting `n_below` is known modulo 2 only, from the sign of the determinant.
    """

    def __init__(
        self,
        matrix: sparse.csc_array,
        diagonal: NDArray[np.float64],
        earlier: SymmetricShift | _GeneralFactor | None,
    ):
        self._scale = 1.0 / np.sqrt(diagonal)
        column = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
        scaled = self._scale[matrix.indices] * matrix.data * self._scale[column]
        self._pattern = matrix.indptr, matrix.indices
        ordered = earlier._ordered(self._pattern) if isinstance(earlier, _GeneralFactor) else None
        factors = ordered or SuperLU(matrix)
        self._factors: SuperLU | PivotedFactors = factors
        try:
            self.n_below = factors.refactor(scaled)
        except ZeroPivotError:
            entries = (scaled, matrix.indices, matrix.indptr)
            pivoted = factors_of(sparse.csc_array(entries, shape=matrix.shape))
            signs = np.count_nonzero(pivoted.U.diagonal() < 0.0)
            self.n_below = int(signs + is_odd(pivoted.perm_r) + is_odd(pivoted.perm_c)) % 2
            self._factors = pivoted

    def _ordered(self, pattern: tuple[NDArray[np.integer], ...]) -> SuperLU | None:
        """A copy of these factors that keeps their order, if the pattern is the same."""
        same = all(map(np.array_equal, self._pattern, pattern))
        return copy(self._factors) if same and isinstance(self._factors, SuperLU) else None

    def solve(self, right: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._scale * self._factors.solve(self._scale * right)
