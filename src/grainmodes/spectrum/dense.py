"""The whole spectrum of a packing from a dense Jacobian: A (21)–(23), (49), (50), (E1).

    J R_n = λ_n R_n,   λ_n = ω_n²
    ψ^R_n = Σ_i |R^ℓ_n,i|²,   ψ^T_n = 1 − ψ^R_n
    p_n = (Σ_i |R_n,i|²)² / (N Σ_i |R_n,i|⁴)

A symmetric J (every s = 0) goes to LAPACK's divide and conquer: a tenth of the time of the general
solver, orthogonal vectors, real values. Rattlers are left out unless they are asked for; their
zero and soft modes belong to no elastic solid.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from grainmodes.jacobian import jacobian
from grainmodes.kernels.laws import Interaction
from grainmodes.packing import Packing, find_contacts, rattlers


@dataclass(frozen=True)
class Spectrum:
    """Eigenvalues (M,), ascending by real part, k_N d^(1/2); the rest is None if not asked for.

    `psi_rotational` and `participation_ratio` are (M,); `residual` is max_n ‖J R_n − λ_n R_n‖ with
    ‖R_n‖ = 1; `modes` is (M, M), one column a mode, degrees of freedom (x, y[, ℓ]) grain by grain.
    """

    eigenvalue: np.ndarray
    psi_rotational: np.ndarray | None = None
    participation_ratio: np.ndarray | None = None
    residual: float | None = None
    modes: np.ndarray | None = None


NO_MODES = Spectrum(np.zeros(0), np.zeros(0), np.zeros(0), 0.0, np.zeros((0, 0)))
"""The spectrum of a packing of rattlers alone."""


def spectrum(
    packing: Packing,
    interaction: Interaction,
    threshold: int = 2,
    keep_rattlers: bool = False,
    modes: bool = True,
) -> Spectrum:
    """The spectrum of a packing; without modes only the eigenvalues are computed.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    if not keep_rattlers:
        gone = rattlers(find_contacts(packing), packing.n, threshold)
        packing = packing.without(gone) if gone.any() else packing
    if packing.n == 0:
        return NO_MODES
    contacts = find_contacts(packing)
    sparse = jacobian(packing, contacts, interaction)
    solve = _symmetric if contacts.tangential_displacement is None else _general
    values, vectors = solve(sparse.toarray(), modes)
    if vectors is None:
        return Spectrum(values)
    weight = np.abs(vectors.reshape(packing.n, -1, len(values))) ** 2
    return Spectrum(
        values,
        rotational_fraction(weight),
        participation_ratio(weight),
        float(np.linalg.norm(sparse @ vectors - vectors * values, axis=0).max()),
        vectors,
    )


def rotational_fraction(weight: np.ndarray) -> np.ndarray:
    """ψ^R of every mode from |R|² of shape (N, k, M): A (50); 0 where rotation does not exist."""
    return weight[:, 2].sum(axis=0) if weight.shape[1] == 3 else np.zeros(weight.shape[2])


def participation_ratio(weight: np.ndarray) -> np.ndarray:
    """p of every mode from |R|² of shape (N, k, M): A (E1)."""
    grain = weight.sum(axis=1)
    return grain.sum(axis=0) ** 2 / (len(grain) * (grain**2).sum(axis=0))


def _symmetric(matrix: np.ndarray, modes: bool):
    if not modes:
        return scipy.linalg.eigh(matrix, eigvals_only=True, overwrite_a=True, driver="evd"), None
    return scipy.linalg.eigh(matrix, overwrite_a=True, driver="evd")


def _general(matrix: np.ndarray, modes: bool):
    if not modes:
        return np.sort_complex(scipy.linalg.eigvals(matrix, overwrite_a=True)), None
    values, vectors = scipy.linalg.eig(matrix, overwrite_a=True)
    order = np.lexsort((values.imag, values.real))
    return values[order], vectors[:, order]
