"""The effective Hessian of A, App. H, the slow way: differences of its quadratic potential."""

from __future__ import annotations

import itertools

import numpy as np

import naive
from grainmodes.parameters.law import ContactLaw


def effective_energy(law: ContactLaw, pairs: list[naive.Pair], u, printed: bool, turn: float = 1.0):
    """U_eff of A (H2) after the motion u (N, 3); turn = −1 counts rotations as (H2) prints them."""
    total = 0.0
    for p in pairs:
        step = u[p.i] + naive.ON_J * u[p.j]
        n, t, r = p.branch / naive.length(p.branch), naive.tangent(p.branch), naive.length(p.branch)
        k_n, k_t = (1.0, law.kt) if printed else slopes(law, p)
        slide = t @ step[:2] + turn * step[2]
        press = naive.normal_force(law, p.reach - r) / r
        total += k_n * (n @ step[:2]) ** 2 - press * (t @ step[:2]) ** 2 + k_t * slide**2
    return total / 2


def slopes(law: ContactLaw, pair: naive.Pair) -> tuple[float, float]:
    """(∂f_N/∂ξ, −∂f_T/∂s) by complex steps."""
    overlap, h = pair.reach - naive.length(pair.branch), 1j * naive.COMPLEX_STEP
    slid = pair.slip + naive.remembered(law, overlap, h)
    f_n, f_t = naive.normal_force(law, overlap + h), naive.tangential_force(law, overlap, slid)
    return f_n.imag / naive.COMPLEX_STEP, -f_t.imag / naive.COMPLEX_STEP


def effective_hessian(
    law: ContactLaw, pairs: list[naive.Pair], n: int, printed: bool, turn: float = 1.0
):
    """∂²U_eff/∂q∂q, dense (3N, 3N): differences of steps of size 1, exact as U_eff is a square."""
    unit = np.eye(3 * n).reshape(-1, n, 3)
    energy = [effective_energy(law, pairs, e, printed, turn) for e in unit]
    matrix = np.diag(2 * np.array(energy))
    for a, b in itertools.combinations(range(3 * n), 2):
        near = [p for p in pairs if {a // 3, b // 3} <= {p.i, p.j}]
        together, one, other = (
            effective_energy(law, near, u, printed, turn)
            for u in (unit[a] + unit[b], unit[a], unit[b])
        )
        matrix[a, b] = matrix[b, a] = together - one - other
    return matrix
