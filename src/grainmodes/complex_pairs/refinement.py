"""Planes of two eigenvectors sharpened: are their eigenvalues right, are they real or a pair?

After a pass of `carried` an eigenvector is right to the square of its coupling; its eigenvalue is
better, but not against the distance of one that it nearly meets. For a plane with R, L and B the
residuals show how much of the other modes l is missing, and in them K is Λ:

    R ← R + V x,     x B − Λ x = V⁻¹ (K R − R B)
    L ← L + V⁻ᵀ y,   y Bᵀ − Λᵀ y = Vᵀ (Kᵀ L − L Bᵀ)

which is x_l = c_l (B − λ_l)⁻¹ with the whole 2 × 2 block: the eigenvalues of B may be far from each
other, or a pair of a large λ_i, with λ_l between them. One step takes a residual to its square,
where no third mode is as near as that. All pairs are taken, and all couples in doubt.

| symbol     | name              | shape                                                     |
| ---------- | ----------------- | --------------------------------------------------------- |
| V⁻¹ (…)    | c                 | (K, 2, M): two rows a plane, on columns of V of norm 1    |
| λ_l        | values            | (M,) complex, a pair's one after the other, λ_i > 0 first |
| their norms| size              | (M,) of Re u, Im u in V                                   |
| Λ          |                   | ((λ_r, λ_i), (−λ_i, λ_r)) on Re u and Im u                |
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from grainmodes.complex_pairs.eigenbasis import Basis
from grainmodes.complex_pairs.invariant_subspaces import Couples
from grainmodes.complex_pairs.partitioning import Solved
from grainmodes.response.stability import REAL

SHARP = 1e-4
"""Residual of a sharpened plane, in units of max|K|; λ is right to about its square."""

STEPS = 3
"""Steps after which a plane that is not sharp will not become so."""

MANY = 0.25
"""Couples in doubt, in units of all modes, from which another pass costs less."""

HOPELESS = 0.125
"""Share of blunt planes after a step from which another pass costs less."""

CLOSE = 1e-4
"""|λ1 − λ2|, k_N d^(1/2)/m, within which a pass does not tell a pair from two real modes."""

LOOSE = 0.3
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
    """The planes of all pairs and of what may be some; None where they do not become sharp."""
    doubtful = nearly_meeting(found.values, found.coupling)
    if len(doubtful) > MANY * len(found.values):
        return None
    places = _with_pairs(doubtful, found.values)
    now = Couples.of(matrix, basis.columns(places), basis.rows(places))
    blunt = now.residual >= SHARP
    blunt[: len(doubtful)] = True
    for _ in range(STEPS):
        if not blunt.any():
            return now
        better = _improved(now.at(blunt), basis, found.values, places[blunt])
        now = now.with_those(blunt, Couples.of(matrix, *better))
        blunt = ~(now.residual < SHARP)
        if blunt.sum() > HOPELESS * len(blunt):
            return None
    return None if blunt.any() else now


def _with_pairs(couples: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Places (K, 2) of couples and then of all pairs that are not among them."""
    alone = values.imag > REAL
    alone[couples] = False
    (alone,) = np.nonzero(alone)
    return np.vstack([couples, np.stack([alone, alone + 1], axis=1)])


def _improved(
    now: Couples, basis: Basis, values: np.ndarray, places: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """R and L (K, 2, M) one step nearer to those of K."""
    vectors, size, inverse = basis
    others = _without(_times(now.missing, inverse.T), places)
    right = now.right + _times(_divided(others, now.block, values, size), vectors.T)
    others = _without(_times(now.missing_left, vectors), places)
    block, values = now.block.swapaxes(1, 2), values.conj()
    return right, now.left + _times(_divided(others, block, values, 1.0 / size), inverse)


def _times(planes: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Every row of planes (K, 2, M) times a matrix (M, M), in single precision."""
    rows = planes.reshape(-1, planes.shape[2]).astype(np.float32, copy=False)
    return (rows @ matrix).reshape(planes.shape)


def _without(coordinates: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Coordinates (K, 2, M) of what is missing of planes, those within each plane left out."""
    coordinates[np.arange(len(places))[:, None], :, places] = 0.0
    return coordinates


@np.errstate(divide="ignore", invalid="ignore", over="ignore")  # it then stays blunt
def _divided(
    coordinates: np.ndarray, block: np.ndarray, values: np.ndarray, size: np.ndarray
) -> np.ndarray:
    """The x of x B − Λ x = c; on α Re u + β Im u of a pair Λ multiplies α − iβ by λ."""
    (pair,) = np.nonzero(values.imag)
    one, two = pair[::2], pair[1::2]
    ratio = (size[one] / size[two]).astype(np.float32)
    c = coordinates.astype(np.complex64)
    c[:, :, one] -= 1j * ratio * coordinates[:, :, two]
    (p, q), (r, s) = np.moveaxis(block, 0, -1)[..., None]
    p, s = ((of - values).astype(np.complex64) for of in (p, s))
    q, r = (of.astype(np.float32) for of in (q, r))
    scale = 1.0 / (p * s - q * r)
    x = np.stack([c[:, 0] * s - c[:, 1] * r, c[:, 1] * p - c[:, 0] * q], axis=1) * scale[:, None]
    x.real[:, :, two] = -x.imag[:, :, one] / ratio
    return x.real
