"""The density of states by counting: exact numbers of modes in bins, without an eigenvalue.

The number of eigenvalues of J in [ω_a², ω_b²) is the difference of two counts (`shift`). On the
same edges it equals the histogram of a dense spectrum; it needs no memory beyond sparse factors.

**ψ^R per bin, by counting twice.** With P_T and P_R the projectors on translations and rotations,

    C(σ_T, σ_R) = number of negative eigenvalues of J − σ_T P_T − σ_R P_R

grows by the number of modes when (σ_T, σ_R) moves from (a, a) to (b, b). On the way by the corner
(a, b) the first leg, in σ_R alone, is crossed by a mode with a probability ψ^R_n as ∂λ_n/∂σ_R =
−ψ^R_n (Hellmann–Feynman); so is the second leg on the way by (b, a). Their mean

    Σ_bin ψ^R ≈ ½ {[C(a,b) − C(a,a)] + [C(b,b) − C(b,a)]}

has two errors. *Chance*: a mode of fraction ψ, anywhere in the cell, contributes 0, ½ or 1 with a
variance v = ½ ψ (1 − 2ψ) for ψ ≤ ½, and the same of 1 − ψ above; v is concave, so that a cell of n
modes has at most n v(mean ψ), less where levels repel. *Step*: curved crossings leave a bias that
grows as the square of the cell; joining cells in pairs measures it, bias ≈ (joined − single)/3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainmodes.linalg.symmetric_shift import SymmetricShift


class Sums(NamedTuple):
    """Σ ψ^R over the modes of each bin (B,), and its standard error (B,)."""

    total: np.ndarray
    error: np.ndarray


def counts(shift: SymmetricShift, frequency: np.ndarray) -> np.ndarray:
    """Number of eigenvalues of J below ω² for each ω > 0 of `frequency` (E,); (E,) int."""
    return np.array([shift.factor_at(omega**2).n_below for omega in frequency])


def rotational_sums(
    shift: SymmetricShift, below: np.ndarray, edges: np.ndarray, k: int, cells_per_bin: int
) -> Sums:
    """Σ ψ^R of the modes in each bin, by counts in two shifts.

    Args:
        shift: of a J with k degrees of freedom a grain, the third its rotation.
        below: (B + 1,) `counts` at the edges.
        edges: (B + 1,) ω of the bins, 1/t_0, ascending.
        cells_per_bin: cells of a bin, at least 1.
    """
    if k < 3:
        return Sums(np.zeros(len(edges) - 1), np.zeros(len(edges) - 1))
    nodes = _subdivided(edges**2, cells_per_bin)
    diagonal = np.repeat(below, cells_per_bin)[: len(nodes)]
    for place in range(len(nodes)):
        if place % cells_per_bin:
            diagonal[place] = shift.factor_at(nodes[place]).n_below
    rotation = np.arange(shift.size) % k == 2
    single = _cells(shift, nodes, diagonal, rotation)
    joined = _cells(shift, nodes[::2], diagonal[::2], rotation)
    return _summed(single, joined, np.diff(diagonal), cells_per_bin)


def _subdivided(edges: np.ndarray, cells_per_bin: int) -> np.ndarray:
    """Each interval of `edges` in `cells_per_bin` equal parts."""
    part = np.arange(cells_per_bin) / cells_per_bin
    inner = edges[:-1, None] + part * np.diff(edges)[:, None]
    return np.append(inner.ravel(), edges[-1])


def _cells(shift: SymmetricShift, nodes, diagonal, rotation) -> np.ndarray:
    """½ {[C(a,b) − C(a,a)] + [C(b,b) − C(b,a)]} of every cell; 0 where the cell is empty."""
    total = np.zeros(len(nodes) - 1)
    for cell in np.flatnonzero(np.diff(diagonal)):
        a, b = nodes[cell : cell + 2]
        rotations_first = shift.factor_at(np.where(rotation, b, a)).n_below - diagonal[cell]
        rotations_last = diagonal[cell + 1] - shift.factor_at(np.where(rotation, a, b)).n_below
        total[cell] = 0.5 * (rotations_first + rotations_last)
    return total


def _summed(single, joined, modes, cells_per_bin: int) -> Sums:
    """Cells gathered into bins, with the errors of chance and of step."""
    part = (single + 0.5) / (modes + 1.0)
    smaller = np.minimum(part, 1.0 - part)
    chance = np.where(modes > 0, modes * 0.5 * smaller * np.abs(1.0 - 2.0 * smaller), 0.0)
    bias = np.zeros(len(single))
    pairs = len(single) // 2
    step = (joined[:pairs] - single[: 2 * pairs].reshape(-1, 2).sum(axis=1)) / 3.0
    bias[: 2 * pairs] = np.repeat(0.5 * step, 2)
    if len(single) > 2 * pairs > 0:
        bias[-1] = bias[-2]
    bins = (-1, cells_per_bin)
    error = np.sqrt(chance.reshape(bins).sum(axis=1) + bias.reshape(bins).sum(axis=1) ** 2)
    return Sums(single.reshape(bins).sum(axis=1), error)
