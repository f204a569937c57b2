"""The density of states from inertia counts: exact numbers of modes in bins, without eigenvalues.

The number of eigenvalues of J in [ω_a², ω_b²) is the difference of two inertia counts (Sylvester,
`linalg.symmetric_shift`). On the same edges it equals the histogram of a dense spectrum; it needs
no memory beyond sparse factors.

**ψ^R per bin, from counts in two shifts.** With P_T and P_R the projectors on translations and
rotations,

    C(σ_T, σ_R) = number of negative eigenvalues of J − σ_T P_T − σ_R P_R

grows by the number of modes when (σ_T, σ_R) moves from (a, a) to (b, b). On the way over the corner
(a, b) only σ_R grows first. A mode n crosses zero on this leg with the probability ψ^R_n, since
∂λ_n/∂σ_R = −ψ^R_n (Hellmann–Feynman). On the way over (b, a) the same holds for the second leg.
Their mean

    Σ_bin ψ^R ≈ ½ {[C(a,b) − C(a,a)] + [C(b,b) − C(b,a)]}

has two errors. *Chance*: a mode of fraction ψ, anywhere in the cell, contributes 0, ½ or 1 with a
variance v = ½ ψ (1 − 2ψ) for ψ ≤ ½, and the same of 1 − ψ above; v is concave, so that a cell of n
modes has at most n v(mean ψ), less where levels repel. *Cell size*: curved crossings leave a bias
that grows as the square of the cell. Joining cells in pairs measures it:
bias ≈ (joined − single)/3.

| symbol  | name           | shape                                          |
| ------- | -------------- | ---------------------------------------------- |
| ω_a     | edges          | (B + 1,), 1/t_0, ascending                     |
| a, b    | nodes          | squares of the edges of cells, 1/t_0²          |
| C(a, a) | n_below        | int: eigenvalues of J below a                  |
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grainmodes.linalg.symmetric_shift import SymmetricShift
from grainmodes.statistics.binning import BinSums


def count_below(shift: SymmetricShift, frequency: NDArray[np.float64]) -> NDArray[np.int64]:
    """Number of eigenvalues of J below ω², for each ω > 0 of `frequency` (E,) in 1/t_0; (E,) int.

    Raises:
        ZeroPivotError: J − ω² is singular however ω² is changed.
    """
    return np.array([shift.factor_at(omega**2).n_below for omega in frequency])


def rotational_sums(
    shift: SymmetricShift,
    n_below: NDArray[np.int64],
    edges: NDArray[np.float64],
    k: int,
    cells_per_bin: int,
) -> BinSums:
    """Σ ψ^R of the modes in each bin, from counts in two shifts; zero where k = 2.

    Args:
        shift: of a J with k rows per grain, the third of them its rotation.
        n_below: (B + 1,) from `count_below` at the edges.
        edges: (B + 1,) ω of the bins, 1/t_0, ascending.
        cells_per_bin: number of equal cells of ω² in each bin, at least 1.

    Raises:
        ZeroPivotError: as `count_below`.
    """
    if k < 3:
        return BinSums(np.zeros(len(edges) - 1), np.zeros(len(edges) - 1))
    nodes = _subdivided(edges**2, cells_per_bin)
    diagonal = np.repeat(n_below, cells_per_bin)[: len(nodes)]
    for place in range(len(nodes)):
        if place % cells_per_bin:
            diagonal[place] = shift.factor_at(nodes[place]).n_below
    is_rotation = np.arange(shift.size) % k == 2
    single = _cell_sums(shift, nodes, diagonal, is_rotation)
    joined = _cell_sums(shift, nodes[::2], diagonal[::2], is_rotation)
    return _gathered(single, joined, np.diff(diagonal), cells_per_bin)


def _subdivided(edges: NDArray[np.float64], parts: int) -> NDArray[np.float64]:
    """The ends of `parts` equal parts of each interval between `edges`."""
    part = np.arange(parts) / parts
    inner = edges[:-1, None] + part * np.diff(edges)[:, None]
    return np.append(inner.ravel(), edges[-1])


def _cell_sums(
    shift: SymmetricShift,
    nodes: NDArray[np.float64],
    diagonal: NDArray[np.int64],
    is_rotation: NDArray[np.bool_],
) -> NDArray[np.float64]:
    """½ {[C(a,b) − C(a,a)] + [C(b,b) − C(b,a)]} of every cell; 0 where the cell is empty."""
    total = np.zeros(len(nodes) - 1)
    for cell in np.flatnonzero(np.diff(diagonal)):
        a, b = nodes[cell : cell + 2]
        over_a_b = shift.factor_at(np.where(is_rotation, b, a)).n_below
        over_b_a = shift.factor_at(np.where(is_rotation, a, b)).n_below
        total[cell] = 0.5 * ((over_a_b - diagonal[cell]) + (diagonal[cell + 1] - over_b_a))
    return total


def _gathered(
    single: NDArray[np.float64],
    joined: NDArray[np.float64],
    modes: NDArray[np.int64],
    cells_per_bin: int,
) -> BinSums:
    """Sums of cells gathered into bins, with the errors of chance and of cell size."""
    part = (single + 0.5) / (modes + 1.0)
    smaller = np.minimum(part, 1.0 - part)
    variance = np.where(modes > 0, modes * 0.5 * smaller * np.abs(1.0 - 2.0 * smaller), 0.0)
    bias = np.zeros(len(single))
    pairs = len(single) // 2
    bias_of_pair = (joined[:pairs] - single[: 2 * pairs].reshape(-1, 2).sum(axis=1)) / 3.0
    bias[: 2 * pairs] = np.repeat(0.5 * bias_of_pair, 2)
    if len(single) > 2 * pairs > 0:
        bias[-1] = bias[-2]
    bins = (-1, cells_per_bin)
    squared_bias = bias.reshape(bins).sum(axis=1) ** 2
    error = np.sqrt(variance.reshape(bins).sum(axis=1) + squared_bias)
    return BinSums(single.reshape(bins).sum(axis=1), error)
