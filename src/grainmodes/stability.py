"""Complex pairs of eigenvalues, and with them oscillatory instability: A, footnote 1; C.

    M q̈ = −J q,   M = diag(m, m, m/2) grain by grain      iω = ±√(−λ'), λ' of M⁻¹J

The eigenvalues are those of M^(−1/2) J M^(−1/2), which is symmetric where J is.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg

from grainmodes.jacobian import jacobian
from grainmodes.kernels.laws import Interaction
from grainmodes.packing import Packing, find_contacts

INERTIA = np.array([1.0, 1.0, 0.5])
"""Inertia of (x, y, ℓ) in units of m_i: 4 I_i/d_i² = m_i/2."""

REAL = 1e-9
"""|Im λ'| up to which an eigenvalue counts as real, k_N d^(1/2)/m."""


def complex_pairs(packing: Packing, interaction: Interaction) -> int:
    """Number of complex-conjugate pairs of eigenvalues of M⁻¹J, dense; with friction only.

    Raises:
        numpy.linalg.LinAlgError: the eigensolver did not converge.
    """
    matrix = jacobian(packing, find_contacts(packing), interaction).toarray()
    scale = 1.0 / np.sqrt(packing.mass[:, None] * INERTIA).ravel()
    values = scipy.linalg.eigvals(scale[:, None] * matrix * scale, overwrite_a=True)
    return int(np.count_nonzero(values.imag > REAL))
