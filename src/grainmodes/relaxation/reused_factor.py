"""The factors of an earlier J₁, reused to solve with a J that has changed little since.

The factors, corrected for the contacts that have changed (`low_rank_update`), solve J u = f by
iteration,

    u → u + J₁⁻¹ (f − J u),

as long as each iteration reduces the residual to a tenth. Then ‖1 − J₁⁻¹ J‖ < 1, so that no
eigenvalue changes its sign between J₁ and J.

| symbol  | name          | shape, type          | unit        |
| ------- | ------------- | -------------------- | ----------- |
| J       | matrix        | (M, M) sparse CSC    | k_N d^(1/2) |
| f       | force         | (M,) float64         | k_N d^(3/2) |
| u       | u             | (M,) float64         | d           |
| f − J u | residual      | (M,) float64         | k_N d^(3/2) |
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

from grainmodes.relaxation.low_rank_update import BaseFactor, LowRankUpdate

MAX_RESIDUAL_RATIO = 0.1
"""Fraction of the residual that an iteration with reused factors may leave at most."""

MAX_REUSES = 20
"""Number of states that the factors of one J serve at most."""

SOLUTION_TOLERANCE = 1e-12
"""Residual of a solution by reused factors, relative to the force."""


class ReusedFactor(NamedTuple):
    """The factors of an earlier J, and how many states they have served."""

    base: BaseFactor
    age: int


def solve_by_iteration(
    matrix: sparse.csc_array,
    update: LowRankUpdate,
    force: NDArray[np.float64],
    guess: NDArray[np.float64] | None,
) -> NDArray[np.float64] | None:
    """u (M,) with J u = `force`, or None if an iteration leaves too much of the residual.

    Args:
        update: J₁⁻¹ for this J.
        force: (M,).
        guess: a field near u from which the iteration starts, if it has M entries.
    """
    goal = SOLUTION_TOLERANCE * np.abs(force).max(initial=0.0)
    u, residual = np.zeros(len(force)), force
    if guess is not None and guess.size == len(force):
        u = guess.ravel()
        residual = force - matrix @ u
    while (size := np.abs(residual).max(initial=0.0)) > goal:
        u = u + update.solve(residual)
        residual = force - matrix @ u
        if not np.abs(residual).max() < max(MAX_RESIDUAL_RATIO * size, goal):
            return None
    return u
