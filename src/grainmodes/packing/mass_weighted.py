"""The masses of (x, y, ℓ) and the mass-weighted Jacobian: A, footnote 1; C, Eqs. (9)-(11).

    M q̈ = −J q,   M = diag(m, m, m/2) grain by grain,   K = M^(−1/2) J M^(−1/2)

K has the eigenvalues of M⁻¹J and is symmetric where J is. An eigenvector u of K is the motion
q = M^(−1/2) u.

| symbol  | name                   | shape, unit             |
| ------- | ---------------------- | ----------------------- |
| M       | generalized_mass       | (N, 3), m               |
| M^(1/2) | root_mass              | (N, 3), m^(1/2)         |
| K       | mass_weighted_jacobian | (3N, 3N), k_N d^(1/2)/m |
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

INERTIA = np.array([1.0, 1.0, 0.5])
"""Inertia of (x, y, ℓ) in units of m_i: 4 I_i/d_i² = m_i/2."""


def generalized_mass(mass: np.ndarray) -> np.ndarray:
    """M, the inertia of (x, y, ℓ) of every grain, (N, 3) for masses (N,)."""
    return np.asarray(mass[:, None] * INERTIA)


def root_mass(mass: np.ndarray) -> np.ndarray:
    """M^(1/2), (N, 3) for masses (N,)."""
    return np.asarray(np.sqrt(generalized_mass(mass)))


def mass_weighted_jacobian(matrix: sparse.sparray, mass: np.ndarray) -> sparse.csr_array:
    """K = M^(−1/2) J M^(−1/2), (3N, 3N) for J (3N, 3N) and masses (N,)."""
    scale = 1.0 / root_mass(mass).ravel()
    return (sparse.diags_array(scale) @ matrix @ sparse.diags_array(scale)).tocsr()
