"""All eigenvalues of a large K in a disc, by Arnoldi's method on (K − σ)⁻¹.

    (K − σ)⁻¹ u = θ u,   λ = σ + 1/θ

The eigenvalues nearest to σ are those of the largest |θ|. Around a real shift the nearest 60 are
all found, and the disc reaches to the last of them. Around one at a height h above the real axis
the half plane below the axis is mapped into one circle around i/2h of radius 1/2h. An eigenvalue at
a distance r < h from σ lies 2h/r − 1 radii from its middle, and every step of Arnoldi's method
brings it nearer by that factor: one sweep finds all with r up to 0.8 h, however many others stand
at the axis, and no more is waited for.

The left vectors, vᴴ K = λ vᴴ, come from the same factors in the same way, Kᵀ v* = λ v*, and one
that is not among them by inverse iteration at its λ. The translations, known zero modes on both
sides, are kept out of Arnoldi's vectors.

| symbol | name          | shape, meaning                              |
| ------ | ------------- | ------------------------------------------- |
| σ, ρ   | shift, radius | middle and radius of a disc without gaps    |
| λ      | value         | (k,), those with λ_i >= 0                   |
| u, v   | right, left   | (M, P), of those with λ_i > `REAL`          |
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import ArpackError, ArpackNoConvergence, LinearOperator, eigs

from grainmodes.linalg.general_shift import Shifted
from grainmodes.response.stability import REAL

PRECISION = 1e-13
"""Of θ, relative."""

REACH = 0.8
"""Of a disc above the real axis, in units of its height."""

SOLUTIONS = 3
"""Of inverse iteration: one would do from a generic vector."""

SAME = 1e-6
"""Distance, in units of max|K|, within which λ of Kᵀ is that of K."""


class Search(NamedTuple):
    """Eigenvalues wanted, vectors of Arnoldi's method, and sweeps after which it is given up."""

    wanted: int
    width: int
    sweeps: int


ON_AXIS = Search(60, 144, 30)
"""Fewer need more factorisations, more need more memory; 2.4 vectors for each need one sweep."""

ABOVE = Search(12, 48, 1)
"""Enough steps for 0.8 h, and more eigenvalues than ever stood there."""


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
    def number(self) -> int:
        """How many eigenvalues of K it holds, two for every pair."""
        return len(self.value) + np.count_nonzero(self.value.imag)

    def among(self, these: np.ndarray) -> Disc:
        """The disc with some of its eigenvalues only, (k,) bool."""
        pairs = these[self.value.imag > REAL]
        return self._replace(value=self.value[these], right=self.right[:, pairs])


class Discs:
    """Finds discs of one K.

    Args:
        matrix: K, (M, M).
        null: its zero modes on both sides (M, Z), orthonormal.
    """

    def __init__(self, matrix: sparse.csr_array, null: np.ndarray):
        self.size, self._null = matrix.shape[0], null
        self.scale = float(np.abs(matrix.data).max())
        self._factors = Shifted(matrix)
        self._generic = np.random.default_rng(0).standard_normal(self.size)

    def on_axis(self, shift: float) -> Disc:
        """The eigenvalues nearest to a real σ, but for the furthest one and its conjugate.

        Raises:
            ArithmeticError: Arnoldi's method did not converge.
        """
        value, right = self._nearest(shift, self._factors.to(shift).solve)
        distance = np.abs(value - shift)
        inside = (distance < (1.0 - 1e-9) * distance.max()) & (value.imag >= 0.0)
        return _disc(shift, float(distance.max()), value[inside], right[:, inside])

    def above_axis(self, shift: complex) -> Disc:
        """Of the eigenvalues around a complex σ those with λ_i > `REAL`, within 0.8 σ_i at least.

        Raises:
            ArithmeticError: Arnoldi's method broke down.
        """
        value, right = self._nearest(shift, self._factors.to(shift).solve)
        upper = value.imag > REAL
        return _disc(shift, REACH * shift.imag, value[upper], right[:, upper])

    def left(self, disc: Disc) -> np.ndarray:
        """Left vectors (M, P) of the pairs of a disc.

        Raises:
            ArithmeticError: Arnoldi's method did not converge.
        """
        pairs = disc.value[disc.value.imag > REAL]
        if not len(pairs):
            return disc.right
        value, vectors = self._nearest(disc.shift, self._factors.to(disc.shift).solve_transposed)
        distance = np.abs(np.append(value, np.inf)[:, None] - pairs)
        left = np.append(vectors, np.zeros((self.size, 1)), axis=1)[:, distance.argmin(axis=0)]
        for place in np.flatnonzero(distance.min(axis=0) > SAME * self.scale):
            left[:, place] = self._left_at(pairs[place], disc.right[:, place])
        return left.conj()

    def _left_at(self, value: complex, right: np.ndarray) -> np.ndarray:
        """v* of one λ by inverse iteration from u, which it is where K is symmetric."""
        factors, vector = self._factors.to(value), right
        for _ in range(SOLUTIONS):
            vector = factors.solve_transposed(vector)
            vector = vector / np.linalg.norm(vector)
        return vector

    def _nearest(
        self, shift: complex, solve: Callable[[np.ndarray], np.ndarray]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Eigenvalues (k,) nearest to a shift and their vectors (M, k)."""
        search = ABOVE if np.iscomplexobj(shift) else ON_AXIS
        count, width = min(search.wanted, self.size // 4), min(search.width, self.size // 2)
        start = self._without_null(self._generic.astype(type(shift)))
        inverse = LinearOperator(
            (self.size, self.size), lambda x: self._without_null(solve(x)), dtype=start.dtype
        )
        options = {"v0": start, "ncv": width, "maxiter": search.sweeps, "tol": PRECISION}
        try:
            value, vectors = eigs(inverse, count, **options)
        except ArpackNoConvergence as stopped:
            if search is ON_AXIS:
                raise ArithmeticError(f"no eigenvalues near {shift:.6g}: {stopped}") from stopped
            value, vectors = stopped.eigenvalues, stopped.eigenvectors
        except ArpackError as error:
            raise ArithmeticError(f"no eigenvalues near {shift:.6g}: {error}") from error
        return shift + 1.0 / value, vectors

    def _without_null(self, vector: np.ndarray) -> np.ndarray:
        return vector - self._null @ (self._null.T @ vector)


def _disc(shift: complex, radius: float, value: np.ndarray, vectors: np.ndarray) -> Disc:
    """A disc with the vectors of its pairs; the others would fill the memory."""
    return Disc(shift, radius, value, vectors[:, value.imag > REAL])
