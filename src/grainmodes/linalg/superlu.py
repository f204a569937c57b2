"""SciPy's SuperLU for matrices with a symmetric pattern, without pivoting.

The matrix is permuted symmetrically and eliminated in that order. Of a symmetric matrix, L and U
then have the signs of an L D Lᵀ, so that the negative pivots count its negative eigenvalues.
Factors that grow beyond `MAX_FACTOR_GROWTH` are refused.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray
from scipy.sparse.linalg import SuperLU as Factors
from scipy.sparse.linalg import splu

from grainmodes.linalg.factorisation import Number, ZeroPivotError

MAX_FACTOR_GROWTH = 1e9
"""Largest allowed ratio of the entries of the factors to the largest entry of the matrix.

The entries of the matrix are kept to 1e-16 of the factors, so that an inertia count is right at
λ (1 ± 1e-7) even at the worst shift that is accepted."""


class SuperLU:
    """Factors of matrices with one pattern, all eliminated in the order that is found first.

    Args:
        pattern: (M, M) sorted CSC with a symmetric pattern; its values are not read.
    """

    name = "superlu"

    def __init__(self, pattern: sparse.csc_array):
        self._indices, self._indptr, self._shape = pattern.indices, pattern.indptr, pattern.shape
        self._order: NDArray[np.integer] | None = None

    def refactor(self, values: NDArray[Number]) -> int:
        """Factor the matrix with entries `values` (nnz,); as `Factorisation.refactor`."""
        if self._order is None:
            matrix = sparse.csc_array((values, self._indices, self._indptr), shape=self._shape)
            self._order = elimination_order(matrix)
            self._entry_order = _permuted_entries(matrix, self._order)
        order = self._entry_order
        matrix = sparse.csc_array(
            (values[order.data], order.indices, order.indptr), shape=self._shape
        )
        self._factors = _factor_without_pivoting(matrix, "NATURAL")
        if not np.array_equal(self._factors.perm_r, self._factors.perm_c):
            raise ZeroPivotError("a pivot of the factorisation is zero")
        upper = self._factors.U
        largest = np.abs(values).max(initial=1.0)
        if not np.abs(upper.data).max(initial=0.0) < MAX_FACTOR_GROWTH * largest:
            raise ZeroPivotError("a pivot of the factorisation is too small")
        return int(np.count_nonzero(upper.diagonal().real < 0.0))

    def solve(self, right: NDArray[Number], trans: str = "N") -> NDArray[Number]:
        """Solutions (M,) or (M, K) of A x = b, or of Aᵀ x = b where `trans` is "T"."""
        solution = np.empty_like(right)
        solution[self._order] = self._factors.solve(right[self._order], trans)
        return solution


def elimination_order(pattern: sparse.csc_array) -> NDArray[np.integer]:
    """An order (M,) of the unknowns that keeps the factors sparse, by minimum degree.

    Columns with the same entries are eliminated together: in a packing these are the two or three
    unknowns of one grain. The graph that is ordered then has one node for each such group.
    """
    column = np.repeat(np.arange(pattern.shape[1]), np.diff(pattern.indptr))
    row = pattern.indices
    marks = np.bincount(column, np.sqrt(row + 1.0), pattern.shape[1])
    _, group = np.unique(marks, return_inverse=True)
    groups = np.arange(group.max(initial=-1) + 1)
    links = np.unique(group[row] * len(groups) + group[column])
    one, other = (np.concatenate([part, groups]) for part in np.divmod(links, len(groups)))
    # A dominant diagonal: the values do not matter, but no pivot may vanish.
    weight = np.repeat([-1.0, len(groups) + 1.0], [len(links), len(groups)])
    graph = sparse.coo_array((weight, (one, other)), shape=(len(groups), len(groups))).tocsc()
    # perm_c[old] = new
    new_place = _factor_without_pivoting(graph, "MMD_AT_PLUS_A").perm_c
    return np.argsort(new_place[group], kind="stable")


def _factor_without_pivoting(matrix: sparse.csc_array, column_order: str) -> Factors:
    # relax=1: no zeros are added to the factors for longer supernodes; a third faster here.
    options = {"SymmetricMode": True, "Equil": False}
    return factors_of(
        matrix, permc_spec=column_order, diag_pivot_thresh=0.0, relax=1, options=options
    )


def factors_of(matrix: sparse.csc_array, **options: Any) -> Factors:
    """`splu` of a matrix, with the types of this package for what goes wrong.

    SuperLU says the same by a RuntimeError where a pivot vanishes and where it gets no memory.

    Raises:
        ZeroPivotError: the matrix is singular.
        MemoryError: the factors do not fit into memory.
    """
    try:
        return splu(matrix, **options)
    except RuntimeError as error:
        if "singular" in str(error):
            raise ZeroPivotError(f"the matrix is singular ({error})") from error
        raise MemoryError(f"SuperLU: {error}") from error


def _permuted_entries(matrix: sparse.csc_array, order: NDArray[np.integer]) -> sparse.csc_array:
    """The pattern in the new order; each entry holds its place among the old values."""
    places = np.arange(matrix.nnz)
    numbered = sparse.csc_array((places, matrix.indices, matrix.indptr), shape=matrix.shape)
    permuted = numbered[order][:, order].tocsc()
    permuted.sort_indices()
    return permuted
