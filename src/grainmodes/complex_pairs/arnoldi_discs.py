"""All eigenvalues of a large K in a disc, by shift-invert Arnoldi iteration.

    (K − σ)⁻¹ u = θ u,   λ = σ + 1/θ

The eigenvalues nearest to σ have the largest |θ|. Around a real shift the nearest 60 are all found,
and the disc reaches to the last of them. Around a shift at a height h above the real axis the half
plane below the axis is mapped into one circle around i/2h of radius 1/2h. An eigenvalue at a
distance r < h from σ lies 2h/r − 1 radii from the middle of this circle, and every Arnoldi step
brings its Ritz value nearer by that factor. One sweep finds all with r up to 0.8 h, however many
others stand at the axis; the others are not waited for.

The left vectors, vᴴ K = λ vᴴ, come from the same factors in the same way, Kᵀ v* = λ v*. One that
Arnoldi iteration misses is found by inverse iteration at its λ. The translations are zero modes on
both sides and are projected out of the Arnoldi vectors.

| symbol | name          | shape, meaning                                 |
| ------ | ------------- | ---------------------------------------------- |
| σ, ρ   | shift, radius | middle and radius of a disc without gaps       |
| λ      | value         | (k,) complex128, those with λ_i >= 0           |
| u, v   | right, left   | (M, P) complex128, those with λ_i > 0          |
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import ArpackError, ArpackNoConvergence, LinearOperator, eigs

from grainmodes.linalg.general_shift import GeneralShift
from grainmodes.response.stability import REAL_TOLERANCE

ARNOLDI_TOLERANCE = 1e-13
"""Relative error of θ."""

RADIUS_PER_HEIGHT = 0.8
"""Radius of a disc above the real axis, in units of its height."""

INVERSE_ITERATIONS = 3
"""Solutions for one left vector; from a random vector one would do."""

SAME_EIGENVALUE = 1e-6
"""Distance, in units of max|K|, within which two computed eigenvalues are one of K."""


class ArnoldiSettings(NamedTuple):
    """Number of eigenvalues, of Arnoldi vectors, and of restarts after which the search ends."""

    n_eigenvalues: int
    n_vectors: int
    max_restarts: int


ON_AXIS = ArnoldiSettings(60, 144, 30)
"""Fewer eigenvalues need more factorisations, more need more memory. With 2.4 vectors for each one
sweep is enough."""

ABOVE_AXIS = ArnoldiSettings(12, 48, 1)
"""Enough steps for a radius of 0.8 h, and more eigenvalues than ever stood in such a disc."""


class Disc(NamedTuple):
    """Eigenvalues within `radius` of a shift; of a pair the one with λ_i > 0."""

    shift: complex
    radius: float
    value: np.ndarray
    right: np.ndarray

    @property
    def low(self) -> float:
        """σ − ρ."""
        return self.shift.real - self.radius

    @property
    def high(self) -> float:
        """σ + ρ."""
        return self.shift.real + self.radius

    @property
    def n_eigenvalues(self) -> int:
        """Number of eigenvalues of K in the disc, two for every pair."""
        return len(self.value) + int(np.count_nonzero(self.value.imag))

    def subset(self, selected: np.ndarray) -> Disc:
        """The disc with the `selected` eigenvalues only, (k,) bool."""
        pairs = selected[self.value.imag > REAL_TOLERANCE]
        return self._replace(value=self.value[selected], right=self.right[:, pairs])


class DiscSolver:
    """Finds the eigenvalues of one K in discs.

    Args:
        matrix: K, (M, M).
        null: its zero modes on both sides, (M, Z), orthonormal.
    """

    def __init__(self, matrix: sparse.csr_array, null: np.ndarray):
        self.size, self._null = matrix.shape[0], null
        self.scale = float(np.abs(matrix.data).max())
        self._factors = GeneralShift(matrix)
        self._random = np.random.default_rng(0).standard_normal(self.size)

    def on_axis(self, shift: float) -> Disc:
        """The eigenvalues nearest to a real σ, without the furthest one and its conjugate.

        Raises:
            ArithmeticError: the Arnoldi iteration did not converge.
        """
        value, right = self._nearest(shift, self._factors.factor_at(shift).solve)
        distance = np.abs(value - shift)
        inside = (distance < (1.0 - 1e-9) * distance.max()) & (value.imag >= 0.0)
        return _disc(shift, float(distance.max()), value[inside], right[:, inside])

    def above_axis(self, shift: complex) -> Disc:
        """The complex eigenvalues within 0.8 σ_i of a complex σ, and perhaps some further away.

        Raises:
            ArithmeticError: the Arnoldi iteration broke down.
        """
        value, right = self._nearest(shift, self._factors.factor_at(shift).solve)
        upper = value.imag > REAL_TOLERANCE
        return _disc(shift, RADIUS_PER_HEIGHT * shift.imag, value[upper], right[:, upper])

    def left_vectors(self, disc: Disc) -> np.ndarray:
        """Left vectors (M, P) of the pairs of a disc.

        Raises:
            ArithmeticError: the Arnoldi iteration did not converge.
        """
        pairs = disc.value[disc.value.imag > REAL_TOLERANCE]
        if not len(pairs):
            return disc.right
        value, vectors = self._nearest(
            disc.shift, self._factors.factor_at(disc.shift).solve_transposed
        )
        distance = np.abs(np.append(value, np.inf)[:, None] - pairs)
        left = np.append(vectors, np.zeros((self.size, 1)), axis=1)[:, distance.argmin(axis=0)]
        for place in np.flatnonzero(distance.min(axis=0) > SAME_EIGENVALUE * self.scale):
            left[:, place] = self._left_vector_at(pairs[place], disc.right[:, place])
        return left.conj()

    def _left_vector_at(self, value: complex, right: np.ndarray) -> np.ndarray:
        """v* of one λ by inverse iteration from u; both are equal where K is symmetric."""
        factors, vector = self._factors.factor_at(value), right
        for _ in range(INVERSE_ITERATIONS):
            vector = factors.solve_transposed(vector)
            vector = vector / np.linalg.norm(vector)
        return vector

    def _nearest(
        self, shift: complex, solve: Callable[[np.ndarray], np.ndarray]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Eigenvalues (k,) nearest to a shift and their vectors (M, k)."""
        settings = ABOVE_AXIS if np.iscomplexobj(shift) else ON_AXIS
        count = min(settings.n_eigenvalues, self.size // 4)
        n_vectors = min(settings.n_vectors, self.size // 2)
        start = self._without_null(self._random.astype(type(shift)))
        inverse = LinearOperator(
            (self.size, self.size), lambda x: self._without_null(solve(x)), dtype=start.dtype
        )
        options = {
            "v0": start,
            "ncv": n_vectors,
            "maxiter": settings.max_restarts,
            "tol": ARNOLDI_TOLERANCE,
        }
        try:
            value, vectors = eigs(inverse, count, **options)
        except ArpackNoConvergence as stopped:
            if settings is ON_AXIS:
                raise ArithmeticError(f"Arnoldi iteration at {shift:.6g}: {stopped}") from stopped
            value, vectors = stopped.eigenvalues, stopped.eigenvectors
        except ArpackError as error:
            raise ArithmeticError(f"Arnoldi iteration at {shift:.6g}: {error}") from error
        return shift + 1.0 / value, vectors

    def _without_null(self, vector: np.ndarray) -> np.ndarray:
        return np.asarray(vector - self._null @ (self._null.T @ vector))


def _disc(shift: complex, radius: float, value: np.ndarray, vectors: np.ndarray) -> Disc:
    """A disc that keeps the vectors of its pairs only; all of them would fill the memory."""
    return Disc(shift, radius, value, vectors[:, value.imag > REAL_TOLERANCE])
