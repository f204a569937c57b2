"""The complex pairs of one large K without a dense general solve.

The part of K that is not symmetric is small. In the eigenvectors V of the symmetric part

    K = S + A,   S V = V diag(d),   Vᵀ K V = diag(d) + Vᵀ A V

is nearly diagonal, and `nearly_diagonal` gives its eigenvalues window by window. S has its own
cheap ways: LAPACK for symmetric matrices, or certified windows of sparse factors beyond
`DENSE_UP_TO`. Each complex eigenvalue, and each two real ones closer than `CLOSE`, is then iterated
to its plane (`plane`), so that what is returned are eigenpairs of K to a residual of 1e-12.

What it can miss: a pair that stands as two real eigenvalues further than `CLOSE` from each other,
because single precision or the coupling to modes outside its window, taken to second order, puts
them there. Found and missed were counted against LAPACK (docs/paper_c.md).
"""

from __future__ import annotations

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from grainmodes.pairs.definition import Pairs, selected
from grainmodes.pairs.nearly_diagonal import NearlyDiagonal, solved
from grainmodes.pairs.plane import SETTLED, Plane, plane_near, plane_of
from grainmodes.shift import SymmetricShift
from grainmodes.spectrum.full import FLOOR
from grainmodes.spectrum.windows import eigenpairs, split
from grainmodes.stability import REAL

DENSE_UP_TO = 4000
"""Degrees of freedom up to which LAPACK solves the symmetric part."""

CLOSE = 1e-5
"""Distance of two real eigenvalues, k_N d^(1/2)/m, that may be a pair in truth."""

SAME = 1e-9
"""Distance below which two pairs are the same one."""

COLUMNS = 512
"""Columns of Vᵀ A V that are made at once."""


def pairs_from_symmetric(matrix: sparse.csr_array, null: np.ndarray) -> Pairs:
    """Every complex pair of K (M, M) that is found.

    Args:
        null: its known zero modes (M, Z), orthonormal.

    Raises:
        ArithmeticError: the symmetric part has other zero modes, or the windows do not add up.
    """
    diagonal, vectors = eigenvectors(0.5 * (matrix + matrix.T), null)
    skew = (0.5 * (matrix - matrix.T)).tocsr()
    found = solved(NearlyDiagonal.of(diagonal, _within(skew, vectors)))
    if found is None:
        raise ArithmeticError("the eigenvalues of the windows do not add up to the trace")
    places = _candidates(found.values)
    starts = ((vectors @ found.rows[[k, k + 1]].T).astype(float) for k in places)
    return _settled(matrix, [plane_of(matrix, start, start) for start in starts])


def eigenvectors(matrix: sparse.csr_array, null: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (M,), ascending, and eigenvectors (M, M) float32 of a symmetric matrix.

    Raises:
        ArithmeticError: as `pairs_from_symmetric`.
    """
    if matrix.shape[0] <= DENSE_UP_TO:
        values, vectors = scipy.linalg.eigh(matrix.toarray(), overwrite_a=True, driver="evd")
        return values, vectors.astype(np.float32)
    parts = [(-value[::-1], vector[:, ::-1]) for value, vector in reversed(_windows(-matrix, null))]
    parts += [(np.zeros(null.shape[1]), null.astype(np.float32)), *_windows(matrix, null)]
    values = np.concatenate([value for value, _ in parts])
    if len(values) != matrix.shape[0]:
        raise ArithmeticError(f"{len(values)} of {matrix.shape[0]} eigenvectors were found")
    return values, np.concatenate([vector for _, vector in parts], axis=1)


def _windows(matrix: sparse.csr_array, null: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Eigenvalues above `FLOOR`, ascending, and their vectors, window by window."""
    shift = SymmetricShift(matrix.tocsc(), null=null)
    top = 1.0001 * float(np.abs(matrix).sum(axis=1).max())
    found = (eigenpairs(shift, window) for window in split(shift, FLOOR, top))
    return [(value, vector.astype(np.float32)) for value, vector in found]


def _within(skew: sparse.csr_array, vectors: np.ndarray) -> np.ndarray:
    """Vᵀ A V, (M, M) float32."""
    size, single = len(vectors), skew.astype(np.float32)
    product = np.empty((size, size), np.float32)
    for first in range(0, size, COLUMNS):
        columns = slice(first, first + COLUMNS)
        product[:, columns] = vectors.T @ (single @ np.ascontiguousarray(vectors[:, columns]))
    return product


def _candidates(values: np.ndarray) -> np.ndarray:
    """Where two eigenvalues are a pair, or two real ones may be one."""
    pair = values.imag > REAL
    real = np.abs(values.imag) <= REAL
    moving = np.abs(values[:-1]) > CLOSE  # the translations are no pair
    close = moving & real[:-1] & real[1:] & (np.abs(np.diff(values.real)) < CLOSE)
    return np.flatnonzero(pair | np.append(close, False))


def _settled(matrix: sparse.csr_array, starts: list[Plane]) -> Pairs:
    """The pairs that planes lead to, each once."""
    known: dict[complex, Plane] = {}
    for start in starts:
        try:
            plane = plane_near(matrix, start)
        except (
            ArithmeticError,
            RuntimeError,
        ):  # lost, or its shift an eigenvalue to the last digit
            continue
        value = complex(plane.values[0])
        pair = plane.residual <= SETTLED and value.imag > REAL
        if pair and all(abs(value - other) > SAME for other in known):
            known[value] = plane
    value = np.array(list(known))
    right, left = (np.zeros((matrix.shape[0], len(known)), complex) for _ in range(2))
    for place, plane in enumerate(known.values()):
        right[:, place], left[:, place] = plane.vectors[:, 0], plane.left_vectors[:, 0]
    return selected(value, right, left)
