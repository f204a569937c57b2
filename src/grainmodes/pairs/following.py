"""Which complex pair of one state is which of the next.

A pair spans a real plane, Re u and Im u. With the left plane L of the old pair, Lᵀ R = 1, the part
of the new plane R' that lies in the old one is |Lᵀ R'|/√2. It is 1 for the same plane and, unlike
the product of right eigenvectors, 0 for every other plane of the same matrix. Two pairs are the
same one if each has its largest part in the other and both parts are above `SAME`.
"""

from __future__ import annotations

import numpy as np

from grainmodes.pairs.definition import Pairs

SAME = 0.5
"""Part of the new plane in the old one from which two pairs are the same."""


def matched(before: Pairs, after: Pairs) -> list[tuple[int, int]]:
    """Places (old, new) of the pairs that two states have in common."""
    if not len(before.value) or not len(after.value):
        return []
    part = np.minimum(parts(before, after), parts(after, before).T)
    forth, back = part.argmax(axis=1), part.argmax(axis=0)
    return [(i, j) for i, j in enumerate(forth.tolist()) if back[j] == i and part[i, j] > SAME]


def parts(of: Pairs, other: Pairs) -> np.ndarray:
    """Part of the planes of `other` in those `of`, (P, P')."""
    right, left = _planes(of.right), _planes(of.left)
    inner = np.einsum("pna,pnb->pab", left, right)
    within = np.tensordot(left, _planes(other.right), axes=(1, 1))  # (P, 2, P', 2)
    projected = np.einsum("pab,pbqc->pqac", np.linalg.inv(inner), within)
    return np.linalg.norm(projected, axis=(2, 3)) / np.sqrt(2.0)


def _planes(vectors: np.ndarray) -> np.ndarray:
    """Orthonormal bases (P, n, 2) of Re u, Im u for vectors (n, P)."""
    return np.linalg.qr(np.stack([vectors.real.T, vectors.imag.T], axis=2))[0]
