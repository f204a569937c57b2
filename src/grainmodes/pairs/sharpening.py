"""Two eigenvalues that nearly meet, sharpened: are they real, or a pair?

After a pass of `carried` an eigenvector is right to the square of its coupling; its eigenvalue is
better, but not against the distance of one that it nearly meets. For such a plane, with R, L and
B = Lᵀ K R, one more step is taken: what the residuals show of the other modes l is added,

    R ← R + V_l (σ − λ_l)⁻¹ V_l⁻¹ (K R − R B),   L ← L + V_l⁻ᵀ (σ − λ_l)⁻¹ V_lᵀ (Kᵀ L − L Bᵀ)

on all other modes, σ = tr B / 2. The block of the new plane is then right to the fourth power.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from grainmodes.pairs.basis import Basis
from grainmodes.pairs.couples import Couples
from grainmodes.pairs.nearly_diagonal import Solved
from grainmodes.stability import REAL

SHARP = 1e-4
"""Residual of a sharpened plane, in units of max|K|; λ is right to about its square."""

STEPS = 3
"""Steps after which a plane that is not sharp will not become so."""

MANY = 0.17
"""Couples in doubt, a mode, from which another pass costs less."""

CLOSE = 1e-4
"""|λ1 − λ2|, k_N d^(1/2)/m, within which a pass does not tell a pair from two real modes."""

LOOSE = 0.15
"""The same for a strongly coupled mode, in units of its coupling squared; measured."""


def nearly_meeting(values: np.ndarray, coupling: np.ndarray) -> np.ndarray:
    """Places (K, 2) of two eigenvalues that nearly meet, for their coupling; none stands twice."""
    unsure = np.maximum(CLOSE, LOOSE * coupling**2)
    (pairs,) = np.nonzero((values.imag > 0.0) & (2.0 * values.imag < unsure))
    return np.array([*zip(pairs, pairs + 1, strict=True), *_couples(values, unsure)], int).reshape(
        -1, 2
    )


def _couples(values: np.ndarray, unsure: np.ndarray) -> list[tuple[int, int]]:
    """Neighbours among the real eigenvalues, the nearest ones first."""
    (real,) = np.nonzero(values.imag == 0.0)
    real = real[np.argsort(values.real[real], kind="stable")]
    gap = np.diff(values.real[real])
    close = gap < np.maximum(unsure[real[:-1]], unsure[real[1:]])
    found, used = [], set()
    for at in np.argsort(gap[close], kind="stable"):
        couple = tuple(real[np.flatnonzero(close)[at] :][:2].tolist())
        if used.isdisjoint(couple):
            found.append(couple)
            used.update(couple)
    return found


def sharpened(matrix: sparse.csr_array, basis: Basis, found: Solved) -> Couples | None:
    """The planes of all pairs and of what may be some; None where one does not become sharp."""
    doubtful = nearly_meeting(found.values, found.coupling)
    if len(doubtful) > MANY * len(found.values):
        return None
    sure = found.values.imag > REAL
    sure[doubtful] = False
    (sure,) = np.nonzero(sure)
    places = np.vstack([doubtful, np.stack([sure, sure + 1], axis=1)])
    now = Couples.of(matrix, *(of(places) for of in (basis.columns, basis.rows)))
    blunt = now.residual >= SHARP
    blunt[: len(doubtful)] = True
    for _ in range(STEPS):
        if not blunt.any():
            break
        better = _improved(now.at(blunt), basis, found.values, places[blunt])
        now = now.with_those(blunt, Couples.of(matrix, *better))
        blunt = ~(now.residual < SHARP)
    return None if blunt.any() else now


def _improved(
    now: Couples, basis: Basis, values: np.ndarray, places: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """R and L (K, 2, M) one step nearer to those of K."""
    vectors, size, inverse = basis

    def step(missing, block, onto, values, size, back):
        others = (missing.reshape(-1, missing.shape[2]).astype(np.float32) @ onto).reshape(
            missing.shape
        )
        others[np.arange(len(places))[:, None], :, places] = 0.0
        others = _divided(others, block, values, size)
        return (others.reshape(-1, missing.shape[2]) @ back).reshape(missing.shape)

    return (
        now.right + step(now.missing, now.block, inverse.T, values, size, vectors.T),
        now.left
        + step(
            now.missing_left,
            now.block.swapaxes(1, 2),
            vectors,
            values.conj(),
            1.0 / size,
            inverse,
        ),
    )


def _divided(
    coordinates: np.ndarray, block: np.ndarray, values: np.ndarray, size: np.ndarray
) -> np.ndarray:
    """The x of x B − Λ x = c for coordinates c (K, 2, M) in columns of norm 1, of norms `size`.

    On Re u and Im u of a pair, with coordinates α and β, Λ multiplies α − iβ by λ.
    """
    (pair,) = np.nonzero(values.imag)
    one, two = pair[::2], pair[1::2]
    ratio = (size[one] / size[two]).astype(np.float32)
    c = coordinates.astype(np.complex64)
    c[:, :, one] -= 1j * ratio * coordinates[:, :, two]
    (p, q), (r, s) = np.moveaxis(block, 0, -1)[..., None]
    p, s = ((of - values).astype(np.complex64) for of in (p, s))
    q, r = (of.astype(np.float32) for of in (q, r))
    scale = 1.0 / (p * s - q * r)
    x = np.stack([(c[:, 0] * s - c[:, 1] * r) * scale, (c[:, 1] * p - c[:, 0] * q) * scale], axis=1)
    found = x.real
    found[:, :, two] = -x.imag[:, :, one] / ratio
    return found
