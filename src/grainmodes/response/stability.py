"""Eigenvalues that decide the stability of a state: A, footnote 1; B, Figs. 3, 7, 13; C.

The lowest eigenvalue of J shows how far a state is from an instability (B). Complex pairs make
oscillations grow (C):

    M q̈ = −J q,   M = diag(m, m, m/2) grain by grain      iω = ±√(−λ'), λ' of M⁻¹J

The eigenvalues are those of M^(−1/2) J M^(−1/2), which is symmetric where J is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigs

from grainmodes.kernels.laws import Interaction
from grainmodes.linalg.failures import finite
from grainmodes.linalg.pinned_factor import MAX_DENSE_SIZE, PinnedFactor
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import mass_weighted_jacobian
from grainmodes.packing.state import Packing

REAL_TOLERANCE = 1e-9
"""|Im λ'| up to which an eigenvalue counts as real, k_N d^(1/2)/m."""


def count_complex_pairs(packing: Packing, interaction: Interaction) -> int:
    """Number of complex-conjugate pairs of eigenvalues of M⁻¹J, by LAPACK; with friction only.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    return int(
        np.count_nonzero(mass_weighted_eigenvalues(packing, interaction).imag > REAL_TOLERANCE)
    )


def mass_weighted_eigenvalues(packing: Packing, interaction: Interaction) -> np.ndarray:
    """All eigenvalues of M⁻¹J, (3N,) complex in k_N d^(1/2)/m, in no order, by LAPACK.

    The state need not be in balance. Friction must exist.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    matrix = jacobian(packing, interaction)
    weighted = finite(mass_weighted_jacobian(matrix, packing.mass).toarray())
    return scipy.linalg.eigvals(weighted, overwrite_a=True)


def asymmetry(matrix: sparse.csc_array) -> float:
    """max|J − Jᵀ| / max|J|; 0 for an empty J. In B, App. D3, it is 0, without −(f_T/r) n tᵀ."""
    largest = abs(matrix).max() if matrix.nnz else 0.0
    return float(abs(matrix - matrix.T).max() / largest) if largest else 0.0


def lowest_eigenvalue(matrix: sparse.csc_array, factor: PinnedFactor, k: int) -> float:
    """Smallest |λ| of J except its two translations, with the sign of Re λ: B, Sec. IV.

    It is in k_N d^(1/2); NaN without such an eigenvalue.

    Args:
        matrix: J (M, M), with k degrees of freedom per grain.
        factor: its factors, with which J⁻¹ is iterated on forces whose sum is zero.
    """
    size = matrix.shape[0]
    if size <= MAX_DENSE_SIZE:
        values = scipy.linalg.eigvals(finite(matrix.toarray()))
        values = values[np.argsort(np.abs(values))][2:]
        return _signed(values[0]) if len(values) else np.nan
    largest = eigs(**_inverted(size, factor, k), return_eigenvectors=False)
    return _signed(1.0 / largest[0])


class LowestMode(NamedTuple):
    """λ, R of norm 1 (M,), and |J R − λ R|; for a complex pair R is the real part."""

    eigenvalue: float
    vector: np.ndarray
    residual: float


def lowest_mode(matrix: sparse.csc_array, factor: PinnedFactor, k: int) -> LowestMode:
    """The eigenvector of `lowest_eigenvalue`, with its largest component positive: B, Fig. 4.

    A complex pair has no real eigenvector; its residual is then of the size of λ.
    """
    size = matrix.shape[0]
    if size <= MAX_DENSE_SIZE:
        values, vectors = scipy.linalg.eig(finite(matrix.toarray()))
        place = np.argsort(np.abs(values))[2]
        value, vector = values[place], vectors[:, place]
    else:
        largest, vectors = eigs(**_inverted(size, factor, k))
        value, vector = 1.0 / largest[0], vectors[:, 0]
    top = vector[np.argmax(np.abs(vector))]
    real = (vector * (np.abs(top) / top)).real
    real /= np.linalg.norm(real)
    signed = _signed(value)
    return LowestMode(signed, real, float(np.linalg.norm(matrix @ real - signed * real)))


def _inverted(size: int, factor: PinnedFactor, k: int) -> dict:
    """Arguments of `eigs` for the largest eigenvalue of J⁻¹ on fields without a translation."""
    inverse = LinearOperator(
        (size, size),
        matvec=lambda f: _centred(factor.solve(_centred(f, k), refined=False), k),
        dtype=float,
    )
    start = _centred(np.random.default_rng(0).standard_normal(size), k)
    return {"A": inverse, "k": 1, "which": "LM", "v0": start}


def _centred(field: np.ndarray, k: int) -> np.ndarray:
    """A field (kN,) without its translation."""
    grains = field.reshape(-1, k).copy()
    grains[:, :2] -= grains[:, :2].mean(axis=0)
    return grains.ravel()


def _signed(value: complex) -> float:
    return float(np.copysign(abs(value), value.real))
