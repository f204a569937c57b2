"""Inertia counts in exact integers, to compare with the counts of the package.

Doubles are integers times powers of two, so J − σ is a matrix of integers up to a common factor.
Bareiss' elimination keeps it one: its pivots are the leading principal minors, and the number of
sign changes among them is the number of eigenvalues below σ (Jacobi).
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np


def count_below(matrix: np.ndarray, shift: float) -> int:
    """Number of eigenvalues of a symmetric matrix of doubles below `shift`, exactly."""
    rows = integers(matrix, shift)
    signs, before = 1, 1
    changes = 0
    for k in range(len(rows)):
        pivot = rows[k][k]
        if pivot == 0:
            raise ArithmeticError("a leading minor vanishes: take another shift")
        changes += (pivot > 0) != (signs > 0)
        signs = pivot
        for i in range(k + 1, len(rows)):
            head, row, top = rows[i][k], rows[i], rows[k]
            rows[i] = [(pivot * a - head * b) // before for a, b in zip(row, top, strict=True)]
        before = pivot
    return changes


def integers(matrix: np.ndarray, shift: float) -> list[list[int]]:
    """J − σ times a positive power of two, as Python's unbounded integers."""
    exact = [[Fraction(x) for x in row] for row in matrix.tolist()]
    for k in range(len(exact)):
        exact[k][k] -= Fraction(shift)
    common = max(x.denominator for row in exact for x in row)
    return [[int(x * common) for x in row] for row in exact]
