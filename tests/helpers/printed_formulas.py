"""Formulas of papers A and B as they are printed, errors included, to be shown wrong.

n = n_ij and ξ_T t = s (n_y, −n_x): the vector ξ_T of A (D2), (D23), along which t points there.
Index j ≠ i runs over the contacts of grain i, in either order, so every pair is met twice.
"""

from __future__ import annotations

import numpy as np

import naive
from grainmodes.parameters.law import ContactLaw


def both_ways(pairs: list[naive.Pair]):
    """Every pair as (i, j) and as (j, i); s has the same sign from both sides."""
    for p in pairs:
        yield p
        yield naive.Pair(p.j, p.i, -p.branch, p.reach, p.slip)


def parts(pair: naive.Pair):
    """n, ξ_T t, r and ξ of a contact."""
    r = naive.length(pair.branch)
    n = pair.branch / r
    return n, pair.slip * np.array([n[1], -n[0]]), r, pair.reach - r


def normal_block(pair: naive.Pair) -> np.ndarray:
    """J_N,ij of Hertzian grains: A (F1)–(F17)."""
    n, _, r, xi = parts(pair)
    block = np.zeros((3, 3))
    block[:2, :2] = xi**1.5 / r * np.eye(2) - (1.5 + xi / r) * xi**0.5 * np.outer(n, n)
    return block


def tangential_block(pair: naive.Pair, kt: float) -> np.ndarray:
    """J_T,ij of Hertzian grains: A (F2)–(F18)."""
    (nx, ny), (tx, ty), _, xi = parts(pair)
    k, half = kt * xi**0.5, kt * xi**-0.5 / 2
    turn = nx * ty - ny * tx
    return np.array(
        [
            [-k * ny**2 + half * nx * tx, k * nx * ny + half * nx * ty, k * ny + half * nx * turn],
            [k * nx * ny + half * ny * tx, -k * nx**2 + half * ny * ty, -k * nx + half * ny * turn],
            [-k * ny, k * nx, k],
        ]
    )


def tangential_diagonal(pair: naive.Pair, kt: float) -> np.ndarray:
    """What the contact j adds to J_T,ii: A (F20)–(F36), k_T missing in (F24) as printed."""
    (nx, ny), (tx, ty), _, xi = parts(pair)
    k, half = kt * xi**0.5, xi**-0.5 / 2
    turn = nx * ty - ny * tx
    block = -tangential_block(pair, kt)
    block[0, 2] = k * ny + half * nx * turn
    block[1, 2] = -(k * nx + kt * half * ny * turn)
    block[2] = [k * ny, -k * nx, k]
    return block


def jacobian(pairs: list[naive.Pair], n: int, kt: float) -> np.ndarray:
    """J of A, App. F, dense (N, 3, N, 3)."""
    blocks = np.zeros((n, 3, n, 3))
    for p in both_ways(pairs):
        blocks[p.i, :, p.j] += normal_block(p) + tangential_block(p, kt)
        blocks[p.i, :, p.i] += -normal_block(p) + tangential_diagonal(p, kt)
    return blocks


def tilde(blocks: np.ndarray) -> np.ndarray:
    """J̃ made of J: A (36), (37); B (39), (40)."""
    changed, grains = blocks.copy(), np.arange(len(blocks))
    changed[:, :2, :, 2] *= -1
    changed[grains, :2, grains, 2] *= -1
    changed[grains, 2, grains, :2] *= -1
    return changed


def affine_rigidity(pairs: list[naive.Pair], box_length: float) -> float:
    """G_A: A (40)."""
    terms = [p.branch[1] ** 2 * normal_block(p)[0, 0] for p in both_ways(pairs)]
    return sum(terms) / (2 * box_length**2)


def theta_vector(pairs: list[naive.Pair], n: int, kt: float) -> np.ndarray:
    """⟨Θ|: A (45) with J for J̃, (N, 3)."""
    total = np.zeros((n, 3))
    for p in both_ways(pairs):
        back = naive.Pair(p.j, p.i, -p.branch, p.reach, p.slip)
        total[p.i] += p.branch[1] * (normal_block(back) + tangential_block(back, kt))[0]
    return total


def harmonic_block(pair: naive.Pair, kt: float) -> np.ndarray:
    """J_ij of harmonic grains: B (D27)–(D35)."""
    (nx, ny), _, r, xi = parts(pair)
    press = 1 + xi / r
    off = (kt - press) * nx * ny
    return np.array(
        [
            [-1 + press * ny**2 - kt * ny**2, off, -kt * ny],
            [off, -1 + press * nx**2 - kt * nx**2, kt * nx],
            [kt * ny, -kt * nx, kt],
        ]
    )


def harmonic_affine_rigidity(pairs: list[naive.Pair], box_length: float) -> float:
    """g_A of the symmetrised stress: B (43)."""
    total = 0.0
    for p in both_ways(pairs):
        block = harmonic_block(p, 0.0)
        total += p.branch[1] * (p.branch[1] * block[0, 0] + p.branch[0] * block[1, 0])
    return total / (4 * box_length**2)


def tangential_force(law: ContactLaw, overlap, slip):
    """f_T: A (D2)."""
    return law.kt * overlap**0.5 * slip


def harmonic_jacobian(pairs: list[naive.Pair], n: int, kt: float) -> np.ndarray:
    """J of B, (D27)–(D44), dense (N, 3, N, 3)."""
    blocks = np.zeros((n, 3, n, 3))
    for p in both_ways(pairs):
        block = harmonic_block(p, kt)
        blocks[p.i, :, p.j] += block
        blocks[p.i, :2, p.i, :2] -= block[:2, :2]
        blocks[p.i, :2, p.i, 2] -= block[:2, 2]
        blocks[p.i, 2, p.i] += block[2]
    return blocks
